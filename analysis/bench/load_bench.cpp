// Loading a quantised .paim, against what loading cannot do without: bare Zstandard over the same
// sections, and a copy of the values that come of it.
// PAIM_BENCH_LOAD names a .paim to load as well.
#include <benchmark/benchmark.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numbers>
#include <variant>

#include "analysis/bench/ratio.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/codec/codecs.h"
#include "paim/codec/playback.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/zstd_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/format/paim/prefixes.h"
#include "paim/mesh/cache_order.h"

namespace paim::bench {

namespace {

namespace fs = std::filesystem;

constexpr uint32_t kBands = 5;

// A torus of num_rings × num_sides vertices, in the order that files have.
Topology torus(uint32_t num_rings, uint32_t num_sides) {
    Topology topology{num_rings * num_sides, {}};
    for (uint32_t y = 0; y < num_rings; ++y) {
        for (uint32_t x = 0; x < num_sides; ++x) {
            const uint32_t right = (x + 1) % num_sides, below = (y + 1) % num_rings;
            const uint32_t a = y * num_sides + x, b = y * num_sides + right;
            const uint32_t c = below * num_sides + x, d = below * num_sides + right;
            topology.triangles.push_back({a, b, c});
            topology.triangles.push_back({b, d, c});
        }
    }
    return topology;
}

// Planes of num_rings × num_sides values, waves along the torus and noise of one step.
// rms         of the waves, in steps
// roughness   waves around the torus: components without much energy are rough
template <typename Integer>
StoredValues waves(const CacheOrder& order, uint32_t num_sides, uint32_t num_planes, double rms,
                   double roughness, uint64_t seed) {
    RandomStream random(stream_key(seed, 3, num_planes));
    const auto num_vertices = order.topology.num_vertices;
    const double ring = 2.0 * std::numbers::pi * num_sides / num_vertices;
    const double side = 2.0 * std::numbers::pi / num_sides;
    std::vector<Integer> values;
    for (uint32_t plane = 0; plane < num_planes; ++plane) {
        const double across = std::ceil(roughness * random.uniform());
        const double along = std::ceil(roughness * random.uniform());
        const double phase = 6.0 * random.uniform();
        for (const uint32_t v : order.old_vertex) {
            const double x = side * (v % num_sides), y = ring * (v / num_sides);
            const double wave = std::sin(across * x + phase) + std::cos(along * y - phase);
            const double value = rms * wave + random.uniform() - 0.5;
            constexpr double kMax = std::numeric_limits<Integer>::max();
            values.push_back(static_cast<Integer>(std::lround(std::clamp(value, -kMax, kMax))));
        }
    }
    return values;
}

// Amplitudes fall from a quarter of the range to about two steps.
template <typename Integer>
LowRank wave_matrix(const CacheOrder& order, uint32_t num_sides, uint32_t num_planes,
                    uint32_t num_components) {
    LowRank matrix;
    matrix.num_points = order.topology.num_vertices;
    matrix.num_planes = num_planes;
    matrix.num_poses = 100;
    matrix.num_components = num_components;
    matrix.precision = sizeof(Integer) == 1 ? Precision::i8 : Precision::i16;
    matrix.steps.assign(num_planes, 0.01f);
    const double most = 0.25 * std::numeric_limits<Integer>::max();
    matrix.mean = waves<Integer>(order, num_sides, num_planes, most, 4.0, 0);
    for (uint32_t k = 0; k < num_components; ++k) {
        const double rms = most * std::pow(2.0 / most, (k + 1.0) / num_components);
        matrix.components.push_back(
            waves<Integer>(order, num_sides, num_planes, rms, 4.0 + k, k + 1));
        matrix.singular_values.push_back(num_components - k);
    }
    matrix.weights.assign(size_t{num_components} * matrix.num_poses, 0.5f);
    return matrix;
}

template <typename Integer>
Asset wave_model(uint32_t num_rings, uint32_t num_sides, uint32_t num_components) {
    const CacheOrder order = cache_order(torus(num_rings, num_sides));
    Asset asset;
    asset.moving().topology = order.topology;
    asset.vertex_order = VertexOrder::cache;
    asset.moving().layout = {TransferKind::diffuse, kBands, 1};
    asset.moving().positions = wave_matrix<Integer>(order, num_sides, 3, num_components);
    asset.moving().transfer = plain_transfer(
        wave_matrix<Integer>(order, num_sides, asset.moving().layout.num_planes(), num_components));
    asset.name = "waves";
    asset.provenance_json = "{}";
    return asset;
}

// Calls `visit` with every array of predicted values of the codec, beyond those of the matrix.
template <typename Visit>
void for_each_codec_array(const Asset& asset, const Visit& visit) {
    CodedTransfer transfer = asset.moving().transfer;  // rows name values that may be changed
    for (const SectionRow& row : transfer->sections()) {
        if (const auto* values = std::get_if<StoredValues*>(&row.values)) visit(**values);
    }
}

// Means, components and what the codec adds to them, as they lie in memory.
size_t bytes_of_values(const Asset& asset) {
    size_t bytes = 0;
    for (const LowRank* matrix : {&asset.moving().positions, &asset.moving().transfer->matrix}) {
        bytes += matrix->mean.size_bytes();
        for (const StoredValues& component : matrix->components) bytes += component.size_bytes();
    }
    for_each_codec_array(asset, [&](const StoredValues& values) { bytes += values.size_bytes(); });
    return bytes;
}

size_t num_values(const Asset& asset) {
    size_t count = 0;
    for (const LowRank* matrix : {&asset.moving().positions, &asset.moving().transfer->matrix}) {
        count += matrix->num_rows() * (1 + size_t{matrix->num_components});
    }
    for_each_codec_array(asset, [&](const StoredValues& values) { count += values.size(); });
    return count;
}

// The Zstandard frames of a file, and where their contents go.
class BareFrames {
  public:
    explicit BareFrames(const fs::path& path) {
        const ContainerReader reader(path, section::kKindAnimation);
        for (const Section& section : reader.sections()) {
            if (section.codec == SectionCodec::none) continue;
            frames_.push_back(reader.read_stored(section));
            contents_.emplace_back(*zstd_content_size(frames_.back()));
            num_bytes_ += contents_.back().size();
        }
    }

    size_t num_bytes() const { return num_bytes_; }  // of contents

    bool decompress() {
        bool good = true;
        for (size_t j = 0; j < frames_.size(); ++j) {
            good = zstd_decompress(frames_[j], contents_[j]) && good;
        }
        return good;
    }

  private:
    std::vector<std::vector<uint8_t>> frames_, contents_;
    size_t num_bytes_ = 0;
};

// Where the memory of a loaded asset comes from: fresh pages cost time of their own.
enum class Memory { from_system, kept };

void keep_memory(Memory memory) {
#if defined(__GLIBC__)
    constexpr int kGigabyte = 1 << 30;
    mallopt(M_MMAP_THRESHOLD, memory == Memory::kept ? kGigabyte : 128 << 10);
    mallopt(M_TRIM_THRESHOLD, memory == Memory::kept ? kGigabyte : 128 << 10);
#endif
}

// One thread. Counters, medians over the iterations, of processor time:
//   decoded_GB_s       bytes of means and components in memory, a second, where the process has that
//                      memory already
//   fresh_GB_s         the same with all of it fresh from the system
//   as_floats_GB_s     the same if every value were a float
//   of_zstd            time of bare Zstandard over the file's sections, into memory that is there
//                      already / time to load it
//   of_copy            time of one memcpy of the decoded bytes / time to load them
//   zstd_GB_s          decoded bytes a second, if Zstandard were all there is to do
//   bits_per_value     of the file
void load(benchmark::State& state, const fs::path& path) {
    const ThreadLimit limit(1);
    const Asset asset = read_paim(path);
    const auto decoded_bytes = static_cast<double>(bytes_of_values(asset));
    const auto count = static_cast<double>(num_values(asset));
    BareFrames frames(path);
    std::vector<char> from(bytes_of_values(asset), 1), to(from.size(), 2);
    std::vector<double> our_times, fresh_times, zstd_times, zstd_ratios, copy_ratios;
    for (auto _ : state) {
        keep_memory(Memory::from_system);
        const Times fresh = timed([&] { benchmark::DoNotOptimize(read_paim(path)); });
        keep_memory(Memory::kept);
        benchmark::DoNotOptimize(read_paim(path));
        const Times ours = timed([&] { benchmark::DoNotOptimize(read_paim(path)); });
        const Times bare = timed([&] {
            if (!frames.decompress()) state.SkipWithError("frames do not decompress");
        });
        const Times copy = timed([&] {
            std::memcpy(to.data(), from.data(), from.size());
            benchmark::DoNotOptimize(to.data());
            benchmark::ClobberMemory();
        });
        state.SetIterationTime(ours.wall_s);
        our_times.push_back(ours.cpu_s);
        fresh_times.push_back(fresh.cpu_s);
        zstd_times.push_back(bare.cpu_s);
        zstd_ratios.push_back(bare.cpu_s / ours.cpu_s);
        copy_ratios.push_back(copy.cpu_s / ours.cpu_s);
    }
    state.counters["decoded_GB_s"] = 1e-9 * decoded_bytes / median(our_times);
    state.counters["fresh_GB_s"] = 1e-9 * decoded_bytes / median(fresh_times);
    state.counters["as_floats_GB_s"] = 1e-9 * sizeof(float) * count / median(our_times);
    state.counters["of_zstd"] = median(zstd_ratios);
    state.counters["of_copy"] = median(copy_ratios);
    state.counters["zstd_GB_s"] = 1e-9 * decoded_bytes / median(zstd_times);
    state.counters["bits_per_value"] = 8.0 * static_cast<double>(fs::file_size(path)) / count;
}

// Reads a file, or its first bytes, and lights a pose.
void light_first_pose(const fs::path& path, uint64_t most_bytes) {
    const auto asset =
        std::make_shared<const Asset>(read_paim(path, {.prefix = true, .most_bytes = most_bytes}));
    const uint32_t bands = asset->moving().layout.in_bands;
    Playback playback(asset);
    playback.set_light(
        DistantLight({static_cast<int>(bands),
                      std::vector<Vec3f>(sh::num_coefficients(bands), Vec3f(1, 2, 3))}));
    playback.update(0.5, {});
    benchmark::DoNotOptimize(playback.radiance().data());
}

// From opening a file to the radiance of all vertices in a pose, on all threads. Counters, medians
// over the iterations, of wall time:
//   first_ms   of the part that the player shows first (24 MiB, or the shortest that can be played)
//   whole_ms   of the whole file
//   ratio      whole / first
void first_light(benchmark::State& state, const fs::path& path) {
    constexpr uint64_t kFirstBytes = uint64_t{24} << 20;
    const uint64_t first_bytes = std::max(kFirstBytes, read_prefixes(path).front().size_bytes);
    std::vector<double> first_times, whole_times, ratios;
    for (auto _ : state) {
        keep_memory(Memory::from_system);
        const Times first = timed([&] { light_first_pose(path, first_bytes); });
        const Times whole = timed([&] { light_first_pose(path, fs::file_size(path)); });
        state.SetIterationTime(first.wall_s);
        first_times.push_back(first.wall_s);
        whole_times.push_back(whole.wall_s);
        ratios.push_back(whole.wall_s / first.wall_s);
    }
    state.counters["first_ms"] = 1e3 * median(first_times);
    state.counters["whole_ms"] = 1e3 * median(whole_times);
    state.counters["ratio"] = median(ratios);
}

template <typename Integer>
void load_waves(benchmark::State& state, uint32_t num_rings, uint32_t num_sides,
                uint32_t num_components) {
    const fs::path path =
        fs::temp_directory_path() / ("paim-bench-load-" + std::to_string(getpid()) + ".paim");
    write_paim(path, wave_model<Integer>(num_rings, num_sides, num_components));
    load(state, path);
    fs::remove(path);
}

void load_i8(benchmark::State& state, uint32_t num_rings, uint32_t num_sides,
             uint32_t num_components) {
    load_waves<int8_t>(state, num_rings, num_sides, num_components);
}

void load_i16(benchmark::State& state, uint32_t num_rings, uint32_t num_sides,
              uint32_t num_components) {
    load_waves<int16_t>(state, num_rings, num_sides, num_components);
}

void large(benchmark::internal::Benchmark* benchmark) {
    benchmark->UseManualTime()->Iterations(15)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(load_i8, small, 20, 25, 4)->UseManualTime();
BENCHMARK_CAPTURE(load_i16, small, 20, 25, 4)->UseManualTime();
BENCHMARK_CAPTURE(load_i8, vertices_100000, 400, 250, 16)->Apply(large);
BENCHMARK_CAPTURE(load_i16, vertices_100000, 400, 250, 16)->Apply(large);

[[maybe_unused]] const bool registered = [] {
    const char* path = std::getenv("PAIM_BENCH_LOAD");
    if (path == nullptr) return false;
    benchmark::RegisterBenchmark("load_file", load, fs::path(path))
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("first_light_file", first_light, fs::path(path))
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
    return true;
}();

}  // namespace

}  // namespace paim::bench
