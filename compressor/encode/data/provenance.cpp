// How a bake was made, for people and paim-info.
#include "compressor/encode/data/provenance.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "paim/base/json_text.h"

namespace paim {

std::string bake_provenance(const BakeIdentity& identity, const PoseStatistics& total) {
    nlohmann::ordered_json json;
    json["bake_bands"] = identity.layout.in_bands;
    json["sampler"] = identity.sampler;
    json["streams"] = identity.streams;
    json["rays"] = identity.rays;
    if (identity.transfer_error > 0.0) json["transfer_error"] = identity.transfer_error;
    if (!identity.floor.empty()) json["floor"] = identity.floor;
    json["seed"] = fmt::format("{:016x}", identity.seed);
    json["normals"] = identity.normals;
    if (identity.bounces > 0) json["bounces"] = identity.bounces;
    json["bake_noise"] = total.relative_noise();
    return json_text(json);
}

}  // namespace paim
