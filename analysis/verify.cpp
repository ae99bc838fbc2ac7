// Checks that a .paim is within the errors that it states.
#include "analysis/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/same_bake.h"
#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"
#include "paim/cli/light_options.h"
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
        return parse_band_power(options.band_power, bands, options.env_mapping);
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

std::vector<Comparison> those_above(const std::vector<Comparison>& comparisons) {
    std::vector<Comparison> above;
    std::copy_if(comparisons.begin(), comparisons.end(), std::back_inserter(above),
                 [](const Comparison& one) { return !one.within(); });
    return above;
}

// "within what it states", or which errors are above it.
std::string verdict_text(const std::vector<Comparison>& comparisons) {
    const std::vector<Comparison> above = those_above(comparisons);
    std::string text = above.empty() ? "within what it states" : "above what it states: ";
    for (const Comparison& one : above) {
        if (&one != &above.front()) text += ", ";
        text += one.measured.name;
    }
    const bool all_compared = std::all_of(comparisons.begin(), comparisons.end(),
                                          [](const Comparison& one) { return one.stated; });
    return all_compared ? text : text + " (what it does not state for this light is not compared)";
}

void print_json(const AnalyzeOptions& options, const AssetError& error, const BandPower& spectrum,
                const std::vector<Comparison>& comparisons,
                const std::vector<BakeDifference>& differences) {
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
    json["bake_differences"] = nlohmann::ordered_json::object();
    for (const BakeDifference& one : differences) {
        json["bake_differences"][one.name] = {{"file", one.of_file}, {"bake", one.of_bake}};
    }
    json["within"] = those_above(comparisons).empty();
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
    fmt::print("{}: {}\n", options.verify.string(), verdict_text(comparisons));
}

}  // namespace

void verify(const AnalyzeOptions& options) {
    const ThreadLimit threads(options.num_threads);
    const Asset asset = read_paim(options.verify);
    const ErrorStatement statement = read_error_statement(asset, options.verify);
    const BakeReader bake(options.bake_directory);
    const BandPower spectrum =
        choose_band_power(options, statement, bake.identity().layout.in_bands);
    cli::print_notes("paim-analyze", options.band_power, spectrum.notes);
    bake.verify_all();
    const std::vector<BakeDifference> differences = bake_differences(asset, bake);
    say_if_of_another_bake("", options.verify, asset, bake);
    const AssetError error = measure_asset(asset, bake, spectrum);
    const std::vector<Comparison> comparisons =
        compare(error, statement, spectrum.name == statement.band_power);
    if (options.json) {
        print_json(options, error, spectrum, comparisons, differences);
    } else {
        print_text(options, spectrum, comparisons);
    }
    const std::vector<Comparison> above = those_above(comparisons);
    if (above.empty()) return;
    const Comparison& first = above.front();
    throw Error(
        ExitCode::threshold_exceeded,
        fmt::format("{}: expected a {} of at most {:.6g}, as it states, got {:.6g}{}{}",
                    options.verify.string(), first.measured.name, *first.stated,
                    first.measured.value,
                    above.size() > 1 ? fmt::format(" ({} errors are above)", above.size()) : "",
                    differences.empty() ? "" : "; it was made from another bake"));
}

}  // namespace paim
