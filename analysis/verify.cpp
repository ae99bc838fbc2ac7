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
#include "paim/codec/gloss_asset.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/asset_error.h"
#include "paim/metrics/frame_error.h"

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

// What is checked: the geometry and the diffuse transfer of a file, or its gloss.
struct Check {
    std::string of;  // behind the name of an error in messages: empty, or " of the gloss"
    BandPower spectrum;
    AssetError error;
    std::vector<Comparison> comparisons;
    std::vector<BakeDifference> differences;

    bool all_compared() const {
        return std::all_of(comparisons.begin(), comparisons.end(),
                           [](const Comparison& one) { return one.stated.has_value(); });
    }
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

// bake  verified
Check check(const AnalyzeOptions& options, const Asset& asset, const ErrorStatement& statement,
            const BakeReader& bake) {
    Check check;
    check.spectrum = choose_band_power(options, statement, bake.identity().layout.in_bands);
    check.differences = bake_differences(asset, bake);
    check.error = measure_asset(asset, bake, check.spectrum);
    check.comparisons =
        compare(check.error, statement, check.spectrum.name == statement.band_power);
    return check;
}

// Adds the errors of the frames. Files state them apart from those of the coefficients.
void add_frames(const Asset& asset, const BakeReader& gloss, const ErrorStatement& statement,
                Check& check) {
    const FrameError frames = measure_frames(gloss, asset, check.spectrum);
    const auto stated =
        nlohmann::json::parse(asset.provenance_json).value("frames", nlohmann::json());
    const bool same_light = check.spectrum.name == statement.band_power;
    for (const auto& [name, value] : {std::pair("relative_rms", frames.relative_rms),
                                      std::pair("worst_row", frames.worst_row)}) {
        Comparison comparison{{std::string("frames_") + name, value, true}, {}};
        const bool is_stated =
            stated.is_object() && stated.contains(name) && stated[name].is_number();
        if (is_stated && same_light) comparison.stated = stated[name].get<double>();
        check.comparisons.push_back(std::move(comparison));
    }
}

// The gloss of the file. Its positions are those of the file, which are checked without it, and only
// where they are stated again.
Check check_gloss(const AnalyzeOptions& options, const Asset& whole, const BakeReader& bake) {
    if (bake.gloss_rows().empty()) {
        throw_bad_input(
            "{}: expected a file made from this bake, without gloss, got one with gloss",
            bake.directory().string());
    }
    const Asset asset = gloss_asset(whole);
    const BakeReader gloss_bake = bake.gloss();
    const std::string name = options.verify.string() + ": gloss";
    const ErrorStatement statement = read_error_statement(asset, name);
    if (bake_differences(whole, bake).empty()) {
        say_if_of_another_bake("", name, asset, gloss_bake);
    }
    Check gloss = check(options, asset, statement, gloss_bake);
    gloss.of = " of the gloss";
    std::erase_if(gloss.comparisons,
                  [](const Comparison& one) { return !one.measured.of_light && !one.stated; });
    add_frames(asset, gloss_bake, statement, gloss);
    return gloss;
}

struct Above {
    const Comparison& comparison;
    std::string name;  // in messages
};

std::vector<Above> those_above(const std::vector<Check>& checks) {
    std::vector<Above> above;
    for (const Check& check : checks) {
        for (const Comparison& one : check.comparisons) {
            if (!one.within()) above.push_back({one, one.measured.name + check.of});
        }
    }
    return above;
}

// "within what it states", or which errors are above it.
std::string verdict_text(const std::vector<Check>& checks) {
    std::string text;
    for (const Above& one : those_above(checks)) {
        text += (text.empty() ? "above what it states: " : ", ") + one.name;
    }
    if (text.empty()) text = "within what it states";
    const bool all_compared = std::all_of(checks.begin(), checks.end(),
                                          [](const Check& check) { return check.all_compared(); });
    return all_compared ? text : text + " (what it does not state for this light is not compared)";
}

void add_to_json(const Check& check, nlohmann::ordered_json& json) {
    json["light_spectrum"] = check.spectrum.name;
    json["bake_noise"] = check.error.transfer.bake_noise;
    for (const Comparison& comparison : check.comparisons) {
        nlohmann::ordered_json& entry = json["errors"][comparison.measured.name];
        if (comparison.stated) {
            entry["stated"] = *comparison.stated;
        } else {
            entry["stated"] = nullptr;
        }
        entry["measured"] = comparison.measured.value;
        entry["within"] = comparison.within();
    }
    json["worst"] = {{"transfer_vertex", check.error.transfer.worst_vertex},
                     {"transfer_pose", check.error.transfer.worst_pose},
                     {"position_vertex", check.error.geometry.distance.worst_vertex},
                     {"position_pose", check.error.geometry.distance.worst_pose}};
    json["bake_differences"] = nlohmann::ordered_json::object();
    for (const BakeDifference& one : check.differences) {
        json["bake_differences"][one.name] = {{"file", one.of_file}, {"bake", one.of_bake}};
    }
}

// checks  of the whole file, and of its gloss if it has any
void print_json(const AnalyzeOptions& options, const std::vector<Check>& checks) {
    nlohmann::ordered_json json;
    json["paim"] = options.verify.string();
    json["bake"] = options.bake_directory.string();
    add_to_json(checks.front(), json);
    if (checks.size() > 1) add_to_json(checks[1], json["gloss"]);
    json["within"] = those_above(checks).empty();
    fmt::print("{}\n", json_text(json, 2));
}

void print_text(const AnalyzeOptions& options, const std::vector<Check>& checks) {
    for (const Check& check : checks) {
        fmt::print("{}{} against {}, light spectrum {}\n", options.verify.string(),
                   check.of.empty() ? "" : ", its gloss,", options.bake_directory.string(),
                   check.spectrum.name);
        fmt::print("  {:<40}{:>14}{:>14}\n", "", "stated", "measured");
        for (const Comparison& comparison : check.comparisons) {
            const std::string stated =
                comparison.stated ? fmt::format("{:.6g}", *comparison.stated) : "-";
            fmt::print("  {:<40}{:>14}{:>14.6g}{}\n", comparison.measured.name, stated,
                       comparison.measured.value, comparison.within() ? "" : "  above");
        }
    }
    fmt::print("{}: {}\n", options.verify.string(), verdict_text(checks));
}

}  // namespace

void verify(const AnalyzeOptions& options) {
    const ThreadLimit threads(options.num_threads);
    const Asset asset = read_paim(options.verify);
    const ErrorStatement statement = read_error_statement(asset, options.verify);
    const BakeReader bake(options.bake_directory);
    cli::print_notes("paim-analyze", options.band_power,
                     choose_band_power(options, statement, bake.identity().layout.in_bands).notes);
    bake.verify_all();
    say_if_of_another_bake("", options.verify, asset, bake);
    std::vector<Check> checks{check(options, asset, statement, bake)};
    if (asset.moving().gloss) checks.push_back(check_gloss(options, asset, bake));
    if (options.json) {
        print_json(options, checks);
    } else {
        print_text(options, checks);
    }
    const std::vector<Above> above = those_above(checks);
    if (above.empty()) return;
    const Above& first = above.front();
    const bool is_of_another = std::any_of(checks.begin(), checks.end(), [](const Check& check) {
        return !check.differences.empty();
    });
    throw Error(
        ExitCode::threshold_exceeded,
        fmt::format("{}: expected a {} of at most {:.6g}, as it states, got {:.6g}{}{}",
                    options.verify.string(), first.name, *first.comparison.stated,
                    first.comparison.measured.value,
                    above.size() > 1 ? fmt::format(" ({} errors are above)", above.size()) : "",
                    is_of_another ? "; it was made from another bake" : ""));
}

}  // namespace paim
