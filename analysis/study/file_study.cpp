// paim-file-study: size and playing cost of files of a given error, compared with the paper's
// storage at the same error. Prints the table of docs/results/files.md.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compressor/encode/search/target_encode.h"
#include "paim/base/file.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/codec/frame_cost.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/rates.h"

namespace {

using namespace paim;

struct Setting {
    std::string name;
    Precision precision = Precision::i16;
    EncodeTarget target;
};

class Study {
  public:
    Study(const std::filesystem::path& directory, std::filesystem::path file)
        : bake_(directory), file_(std::move(file)) {
        bake_.verify_all();
    }

    // Encodes, measures the written file again, and prints a line.
    TargetSummary measure(const std::string& name, double error, const Setting& setting,
                          const TargetSummary* paper) const {
        EncodeOptions options;
        options.precision = setting.precision;
        options.memory_bytes = 4'000'000'000;
        EncodeTarget target = setting.target;
        target.transfer_error = error;
        target.spectrum = BandPower::flat(bake_.identity().layout.in_bands);
        const TargetSummary summary = encode_to_target(bake_, options, target, file_);
        const Asset asset = read_paim(file_);
        const AssetError measured = measure_asset(asset, bake_, target.spectrum);
        const Candidate& chosen = summary.chosen();
        std::string numbers;
        for (const CodecNumber& number : chosen.numbers) {
            numbers += fmt::format("{}{}", numbers.empty() ? "" : "x", number.value);
        }
        // Multiply-adds of decoding alone, and of light of one channel.
        TransferLayout layout = asset.moving().layout;
        layout.channels = 1;
        const uint64_t grey = asset.moving().transfer->cost(layout, {}, false).decode_per_vertex;
        const double size_ratio = paper == nullptr ? 1.0
                                                   : static_cast<double>(paper->size_bytes) /
                                                         static_cast<double>(summary.size_bytes);
        const double cost_ratio =
            paper == nullptr
                ? 1.0
                : static_cast<double>(paper->chosen().multiply_adds) / chosen.multiply_adds;
        fmt::print(
            "{},{:g},{},{},{},{},{},{},{},{:.3f},{},{},{:.5f},{:.6f},{:.4f},{:.4f},{:.2f},{:.2f}\n",
            name, error, setting.name, chosen.codec, chosen.bands, chosen.components, numbers,
            summary.geometry_components, summary.size_bytes,
            bits_per_vertex_per_pose(summary.size_bytes, summary.num_vertices, summary.num_poses),
            chosen.multiply_adds, grey, measured.transfer.total(), measured.geometry.relative_rms(),
            measured.geometry.kg_error(), measured.geometry.e_rms(), size_ratio, cost_ratio);
        std::fflush(stdout);
        return summary;
    }

  private:
    BakeReader bake_;
    std::filesystem::path file_;
};

int run(int argc, char** argv) {
    CLI::App app(
        "Encodes bakes to errors: the paper's storage (f32, SVD, the fewest components), the "
        "smallest\n"
        "file, and the fastest frame in a file of at most a quarter of the paper's. CSV on stdout.",
        "paim-file-study");
    std::vector<std::filesystem::path> bakes;
    std::vector<double> errors{0.01, 0.02, 0.05};
    std::filesystem::path scratch = "paim-file-study.paim";
    app.add_option("BAKE", bakes, "Bakes")->required();
    app.add_option("--errors", errors, "Transfer errors, fractions")->delimiter(',');
    app.add_option("--scratch", scratch, "The file that is written again and again, and removed")
        ->capture_default_str();
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    fmt::print(
        "sequence,error,what,codec,bands,components,codec_numbers,geometry_components,bytes,bpvf,"
        "multiply_adds,multiply_adds_grey,transfer_error,geometry_error,kg_percent,e_rms,"
        "times_smaller,times_fewer\n");
    for (const auto& directory : bakes) {
        const Study study(directory, scratch);
        for (const double error : errors) {
            const std::string name = directory.stem().string();
            const TargetSummary paper =
                study.measure(name, error, {"paper", Precision::f32, {}}, nullptr);
            study.measure(name, error, {"smallest", Precision::i16, {}}, &paper);
            Setting fastest{"fastest", Precision::i16, {}};
            fastest.target.preference = Preference::speed;
            fastest.target.size_bytes = paper.size_bytes / 4;
            study.measure(name, error, fastest, &paper);
        }
    }
    std::error_code ignored;
    std::filesystem::remove(scratch, ignored);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-file-study", [&] { return run(argc, argv); });
}
