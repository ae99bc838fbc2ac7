// Whether a .paim was made from a bake.
#include "analysis/same_bake.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compressor/encode/data/provenance.h"
#include "paim/base/json_text.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

// Of a member, as much as fits into a message.
std::string text_of(const ordered_json& object, const std::string& name) {
    if (!object.contains(name)) return {};
    const ordered_json& value = object[name];
    return (value.is_string() ? value.get<std::string>() : json_text(value)).substr(0, 200);
}

std::string rows_text(size_t num_rows) {
    return num_rows == 0 ? std::string() : fmt::format("{} vertices", num_rows);
}

// "rays 16 (here 64), seed … (here …)"
std::string differences_text(const std::vector<BakeDifference>& differences) {
    const auto or_none = [](const std::string& text) { return text.empty() ? "none" : text; };
    std::string text;
    for (const BakeDifference& one : differences) {
        text += fmt::format("{}{} {} (here {})", text.empty() ? "" : ", ", one.name,
                            or_none(one.of_file), or_none(one.of_bake));
    }
    return text;
}

}  // namespace

std::vector<BakeDifference> bake_differences(const Asset& asset, const BakeReader& bake) {
    if (asset.provenance_json.empty()) return {};
    const auto of_file = ordered_json::parse(asset.provenance_json);
    const auto of_bake =
        ordered_json::parse(bake_provenance(bake.identity(), bake.total_statistics()));
    bool says_something = false;
    for (const auto& [name, value] : of_bake.items()) says_something |= of_file.contains(name);
    if (!says_something) return {};
    std::vector<BakeDifference> differences;
    // The members that a bake may lack, too.
    for (const char* const name : {"bake_bands", "sampler", "streams", "rays", "transfer_error",
                                   "floor", "seed", "normals", "bounces", "bake_noise"}) {
        BakeDifference one{name, text_of(of_file, name), text_of(of_bake, name)};
        if (one.of_file != one.of_bake) differences.push_back(std::move(one));
    }
    const std::optional<CodedGloss>& gloss = asset.moving().gloss;
    BakeDifference rows{"gloss", rows_text(gloss ? gloss->num_rows : 0),
                        rows_text(bake.gloss_rows().size())};
    if (rows.of_file != rows.of_bake) differences.push_back(std::move(rows));
    return differences;
}

void say_if_of_another_bake(const std::string& tool, const std::filesystem::path& file,
                            const Asset& asset, const BakeReader& bake) {
    const std::vector<BakeDifference> differences = bake_differences(asset, bake);
    if (differences.empty()) return;
    fmt::print(stderr, "{}note: {}: was made from another bake than {}: {}\n",
               tool.empty() ? "" : tool + ": ", file.string(), bake.directory().string(),
               differences_text(differences));
}

}  // namespace paim
