// Encoding a bake of the paper's size with 7 bands, from its directory to the file: wall clock,
// peak memory, and what remains of the bytes. Opt-in, as it writes 2.4 GB: PAIM_BENCH_LARGE names a
// directory with room for it.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "analysis/bench/ratio.h"
#include "analysis/bench/synthetic_bake.h"
#include "compressor/encode/encode.h"
#include "paim/base/error.h"

namespace paim::bench {

namespace {

namespace fs = std::filesystem;

// Forgets the process's peak memory so far (Linux, Documentation/filesystems/proc.rst).
void reset_peak_memory() {
    std::ofstream("/proc/self/clear_refs") << "5";
}

// VmHWM in MB.
double peak_memory_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        double kilobytes = 0.0;
        if (word == "VmHWM:" && status >> kilobytes) return kilobytes * 1.024e-3;
    }
    return 0.0;
}

void encode_large(benchmark::State& state, ComponentChoice components) {
    const char* folder = std::getenv("PAIM_BENCH_LARGE");
    const SyntheticBake synthetic{104000, 103, 7};
    const fs::path directory = fs::path(folder) / "paim-bench-large.bake";
    const fs::path output = fs::path(folder) / "paim-bench-large.paim";
    if (!is_bake(directory)) synthetic.write(directory);
    EncodeOptions options;
    options.geometry = options.transfer = components;
    Times times;
    EncodeSummary summary;
    for (auto _ : state) {
        reset_peak_memory();
        times = timed([&] {
            const BakeReader bake(directory);
            bake.verify_all();
            summary = encode(bake, options, output);
        });
        state.SetIterationTime(times.wall_s);
        state.counters["peak_MB"] = peak_memory_mb();
    }
    fs::remove(output);
    state.counters["cpu_s"] = times.cpu_s;
    state.counters["components"] = summary.transfer_components;
    // Bytes of positions and transfer against those of the file.
    const double baked_bytes = 4.0 * synthetic.num_vertices * synthetic.num_poses *
                               (3.0 + synthetic.bands * synthetic.bands);
    state.counters["compression"] = baked_bytes / static_cast<double>(summary.size_bytes);
}

[[maybe_unused]] const bool registered = [] {
    if (std::getenv("PAIM_BENCH_LARGE") == nullptr) return false;
    using Kind = ComponentChoice::Kind;
    for (const auto& [name, choice] :
         {std::pair{"encode_large/auto", ComponentChoice{}},
          std::pair{"encode_large/all", ComponentChoice{Kind::all, 0}}}) {
        benchmark::RegisterBenchmark(name, encode_large, choice)
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kSecond);
    }
    return true;
}();

}  // namespace

}  // namespace paim::bench
