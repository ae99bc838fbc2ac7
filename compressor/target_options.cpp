// The options of paim-compress that say what a file shall meet.
#include "compressor/target_options.h"

#include <fmt/format.h>

#include "paim/base/error.h"
#include "paim/cli/parse.h"

namespace paim {

namespace {

double parse_share(const std::string& text, const char* option) {
    const double value = cli::parse_fraction(text, option);
    if (!(value > 0.0 && value < 1.0)) {
        throw_usage("{}: expected more than 0 and less than 1 (or 100%), got '{}'", option, text);
    }
    return value;
}

}  // namespace

void add_target_options(CLI::App& app, RawTarget& raw) {
    const auto add = [&](const char* name, auto& value, const std::string& help) {
        return app.add_option(name, value, help);
    };
    add("--max-error", raw.max_error,
        "The error that the transfer may have, a fraction or percentage (0.02, 2%): of radiance, "
        "RMS "
        "over lights, vertices and poses, against a bake without noise. Components, bands, steps "
        "of "
        "integers and codec are then chosen for the smallest file, which is measured before it is "
        "written (docs/metrics.md). Static scenery has to meet it by itself, too. Takes the place "
        "of the options of components");
    add("--geometry-error", raw.geometry_error,
        fmt::format(
            "With --max-error or --max-size: the RMS distance that positions may be off, a "
            "fraction or percentage of the largest pose's diagonal; default: the transfer's "
            "error / {:g}",
            1.0 / kGeometryPerTransferError));
    add("--max-size", raw.max_size,
        "The size that the file may have, bytes or with K, M, G for powers of 1000: the smallest "
        "error that fits, at most 50 %, is found to a few percent of itself (of files below 50 kB, "
        "to a tenth); with --max-error, both must be "
        "met");
    add("--max-decode-cost", raw.max_decode_cost,
        "Multiply-adds that a vertex may take a frame for lit transfer: K + 4 for each coefficient "
        "with svd, 3 (K + 1) in all with cpca; positions, and what a frame takes for the bases of "
        "clusters, come on top");
    add("--codec", raw.codec,
        "How the transfer is coded for --max-error or --max-size: 'svd' (components over poses), "
        "'cpca' (clustered PCA: light comes before weights, far cheaper to play), or what suits "
        "the "
        "target best")
        ->check(CLI::IsMember({"auto", "svd", "cpca"}))
        ->capture_default_str();
    add("--prefer", raw.prefer,
        "Of files that meet the target: 'size' takes the smallest, 'speed' the one that is "
        "cheapest "
        "to play")
        ->check(CLI::IsMember({"size", "speed"}))
        ->capture_default_str();
    add("--light-spectrum", raw.band_power,
        "What errors are weighted by: 'flat' light has as much of every band, 'natural' has less "
        "of "
        "high ones, or a lat-long EXR file: like that one")
        ->capture_default_str();
}

std::optional<EncodeTarget> parse_target(const RawTarget& raw) {
    if (!raw.asked()) {
        const auto needs = [](bool given, const char* option) {
            if (given) throw_usage("{}: goes with --max-error or --max-size", option);
        };
        needs(!raw.geometry_error.empty(), "--geometry-error");
        needs(raw.max_decode_cost.has_value(), "--max-decode-cost");
        needs(raw.codec != "auto", "--codec");
        needs(raw.prefer != "size", "--prefer");
        needs(raw.band_power != "flat", "--light-spectrum");
        return std::nullopt;
    }
    EncodeTarget target;
    if (!raw.max_error.empty()) target.transfer_error = parse_share(raw.max_error, "--max-error");
    if (!raw.geometry_error.empty()) {
        target.geometry_error = parse_share(raw.geometry_error, "--geometry-error");
    }
    if (!raw.max_size.empty()) target.size_bytes = cli::parse_bytes(raw.max_size, "--max-size");
    target.decode_cost = raw.max_decode_cost;
    if (raw.codec == "svd") target.codec = CodecChoice::svd;
    if (raw.codec == "cpca") target.codec = CodecChoice::cpca;
    if (raw.prefer == "speed") target.preference = Preference::speed;
    return target;
}

}  // namespace paim
