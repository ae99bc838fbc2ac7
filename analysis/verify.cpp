// Checks that a .paim is within the errors that it states.
#include "analysis/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/asset_error.h"

namespace paim {

namespace {

// Relative tolerance: other compilers and processors may round differently.
constexpr double kRounding = 1e-6;

struct Comparison {
    NamedError measured;
    std::optional<double> stated;

    // Written so that NaN is never within.
    bool within() const { return !stated || measured.value <= *stated * (1.0 + kRounding); }
};

BandPower choose_band_power(const AnalyzeOptions& options, const ErrorStatement& statement,
                            uint32_t bands) {
    if (!options.band_power.empty()) {
        return parse_band_power(options.band_power, bands);
    }
    if (statement.band_power != "flat" && statement.band_power != "natural") {
        throw_usage("{}: its errors are those under {}; give this file with --light-spectrum",
                    options.verify.string(), statement.band_power);
    }
    return parse_band_power(statement.band_power, bands);
}

std::vector<Comparison> compare(const AssetError& error, const ErrorStatement& statement,
                                bool same_light) {
    std::vector<Comparison> comparisons;
    for (const NamedError& measured : named_errors(error)) {
        Comparison comparison{measured, {}};
        for (const NamedError& stated : statement.errors) {
            if (stated.name == measured.name && (same_light || !measured.of_light)) {
                comparison.stated = stated.value;
            }
        }
        comparisons.push_back(std::move(comparison));
    }
    return comparisons;
}

void print_json(const AnalyzeOptions& options, const AssetError& error, const BandPower& spectrum,
                const std::vector<Comparison>& comparisons) {
    nlohmann::ordered_json json;
    json["paim"] = options.verify.string();
    json["bake"] = options.bake_directory.string();
    json["light_spectrum"] = spectrum.name;
    json["bake_noise"] = error.transfer.bake_noise;
    for (const Comparison& comparison : comparisons) {
        nlohmann::ordered_json& entry = json["errors"][comparison.measured.name];
        if (comparison.stated) {
            entry["stated"] = *comparison.stated;
        } else {
            entry["stated"] = nullptr;
        }
        entry["measured"] = comparison.measured.value;
        entry["within"] = comparison.within();
    }
    json["worst"] = {{"transfer_vertex", error.transfer.worst_vertex},
                     {"transfer_pose", error.transfer.worst_pose},
                     {"position_vertex", error.geometry.distance.worst_vertex},
                     {"position_pose", error.geometry.distance.worst_pose}};
    fmt::print("{}\n", json_text(json, 2));
}

void print_text(const AnalyzeOptions& options, const BandPower& spectrum,
                const std::vector<Comparison>& comparisons) {
    fmt::print("{} against {}, light spectrum {}\n", options.verify.string(),
               options.bake_directory.string(), spectrum.name);
    fmt::print("  {:<40}{:>14}{:>14}\n", "", "stated", "measured");
    for (const Comparison& comparison : comparisons) {
        const std::string stated =
            comparison.stated ? fmt::format("{:.6g}", *comparison.stated) : "-";
        fmt::print("  {:<40}{:>14}{:>14.6g}{}\n", comparison.measured.name, stated,
                   comparison.measured.value, comparison.within() ? "" : "  above");
    }
}

}  // namespace

void verify(const AnalyzeOptions& options) {
    const ThreadLimit threads(options.num_threads);
    const Asset asset = read_paim(options.verify);
    const ErrorStatement statement = read_error_statement(asset, options.verify);
    const BakeReader bake(options.bake_directory);
    const BandPower spectrum =
        choose_band_power(options, statement, bake.identity().layout.in_bands);
    bake.verify_all();
    const AssetError error = measure_asset(asset, bake, spectrum);
    const std::vector<Comparison> comparisons =
        compare(error, statement, spectrum.name == statement.band_power);
    if (options.json) {
        print_json(options, error, spectrum, comparisons);
    } else {
        print_text(options, spectrum, comparisons);
    }
    const auto above = std::find_if(comparisons.begin(), comparisons.end(),
                                    [](const Comparison& c) { return !c.within(); });
    if (above == comparisons.end()) return;
    throw Error(ExitCode::threshold_exceeded,
                fmt::format("{}: expected a {} of at most {:.6g}, as it states, got {:.6g}",
                            options.verify.string(), above->measured.name, *above->stated,
                            above->measured.value));
}

}  // namespace paim
