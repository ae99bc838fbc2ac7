// Whether a .paim was made from a bake.
#include "analysis/same_bake.h"

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
    return differences;
}

}  // namespace paim
