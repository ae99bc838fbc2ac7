// paim-error-study: how near the errors that files state come to the true ones. Prints the table of
// stated errors of docs/results/metrics.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "compressor/encode/search/target_encode.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/asset_error.h"

namespace {

using namespace paim;

// Squared errors, not weighted by any light.
struct SquaredError {
    double stated = 0.0;  // of the decoded transfer to the truth, as estimated from the bake alone
    double truth = 0.0;   // the same, measured against a bake of many rays
};

// The noise of the bake of many rays is known, and taken out.
SquaredError squared_error(const TransferError& to_bake, const TransferError& to_truth) {
    SquaredError sum;
    for (size_t l = 0; l < to_bake.bands.size(); ++l) {
        sum.stated += to_bake.bands[l].expected();
        sum.truth += to_truth.bands[l].error_to_bake - to_truth.bands[l].noise;
    }
    return sum;
}

double true_energy(const TransferError& to_truth) {
    double sum = 0.0;
    for (const TransferBandEnergy& band : to_truth.bands) sum += band.baked - band.noise;
    return sum;
}

class Study {
  public:
    Study(const std::filesystem::path& bake, const std::filesystem::path& truth,
          std::filesystem::path file)
        : bake_(bake),
          truth_(truth),
          file_(std::move(file)),
          flat_(BandPower::flat(bake_.identity().layout.in_bands)) {}

    void print(const std::string& codec, double error) const {
        EncodeOptions options;
        options.precision = Precision::i16;
        options.memory_bytes = 4'000'000'000;
        EncodeTarget target;
        target.codec = codec;
        target.transfer_error = error;
        target.spectrum = flat_;
        const std::string name = bake_.directory().stem().string();
        try {
            encode_to_target(bake_, options, target, file_);
        } catch (const Error& e) {
            if (e.code() != ExitCode::threshold_exceeded) throw;
            fmt::print("{},{},{:g},,,,,\n", name, codec, error);
            return;
        }
        const Asset asset = read_paim(file_);
        const TransferError to_bake = measure_asset(asset, bake_, flat_).transfer;
        const TransferError to_truth = measure_asset(asset, truth_, flat_).transfer;
        const SquaredError sum = squared_error(to_bake, to_truth);
        const double all = true_energy(to_truth);
        const double stated = std::sqrt(sum.stated / all);
        const double truth = std::sqrt(sum.truth / all);
        fmt::print("{},{},{:g},{},{:.5f},{:.5f},{:.5f},{:.4f}\n", name, codec, error,
                   std::filesystem::file_size(file_), to_bake.bake_noise, stated, truth,
                   stated / truth);
        std::fflush(stdout);
    }

  private:
    BakeReader bake_, truth_;
    std::filesystem::path file_;
    BandPower flat_;
};

int run(int argc, char** argv) {
    CLI::App app(
        "Encodes a bake of few rays to errors, and compares the errors that the files state with\n"
        "the true ones, by a bake of the same poses with many rays and another seed. CSV on stdout.",
        "paim-error-study");
    std::filesystem::path bake, truth;
    std::vector<double> errors{0.02, 0.05, 0.1};
    std::vector<std::string> codecs;
    for (const TransferEncoderType& type : transfer_encoders()) codecs.emplace_back(type.codec);
    std::filesystem::path scratch = "paim-error-study.paim";
    app.add_option("BAKE", bake, "The bake that is encoded")->required();
    app.add_option("TRUTH", truth, "The bake of many rays")->required();
    app.add_option("--errors", errors, "Transfer errors, fractions")->delimiter(',');
    app.add_option("--codecs", codecs, "Codecs")->delimiter(',');
    app.add_option("--scratch", scratch, "The file that is written again and again, and removed")
        ->capture_default_str();
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    fmt::print("bake,codec,asked,bytes,bake_noise,stated_error,true_error,stated_over_true\n");
    const Study study(bake, truth, scratch);
    for (const std::string& codec : codecs) {
        for (const double error : errors) study.print(codec, error);
    }
    std::error_code ignored;
    std::filesystem::remove(scratch, ignored);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-error-study", [&] { return run(argc, argv); });
}
