// The JSON metadata of a .paim.
#include "paim/format/paim/paim_metadata.h"

#include <nlohmann/json.hpp>

#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/codec/codecs.h"
#include "paim/codec/section_row.h"

namespace paim {

namespace {

constexpr const char* kSingularIndices[2] = {"geometry_singular_indices",
                                             "transfer_singular_indices"};

bool has_floor(const CodedMesh& mesh) {
    return !mesh.root_motion.empty() && mesh.num_following < mesh.topology.num_vertices;
}

const char* transfer_kind(const CodedMesh& mesh) {
    if (mesh.root_motion.empty()) return kDiffuse;
    return has_floor(mesh) ? kDiffuseLocalOnFloor : kDiffuseLocal;
}

}  // namespace

std::string paim_metadata(const Asset& asset) {
    const CodedMesh& mesh = asset.moving();
    nlohmann::ordered_json root;
    root["name"] = asset.name;
    root["num_vertices"] = mesh.topology.num_vertices;
    root["num_poses"] = asset.num_poses();
    root["frames_per_second"] = asset.frames_per_second;
    if (const Vec3d& o = asset.origin; !o.isZero(0.0)) root["origin"] = {o.x(), o.y(), o.z()};
    root["transfer_kind"] = transfer_kind(mesh);
    if (has_floor(mesh)) root["num_following"] = mesh.num_following;
    root["bands"] = mesh.layout.in_bands;
    root["channels"] = mesh.layout.channels;
    if (asset.vertex_order == VertexOrder::cache) root["vertex_order"] = "local";
    if (const std::string_view codec = mesh.transfer->codec_name(); is_named_in_files(codec)) {
        root["codec"] = codec;
    }
    for (const NamedNumber& number : mesh.transfer->numbers()) {
        root[number.name] = *number.value;
    }
    root["geometry_components"] = mesh.positions.num_components;
    root["transfer_components"] = mesh.transfer->matrix.num_components;
    if (const uint32_t bits = mesh.positions.fraction_bits; bits > 0) {
        root["geometry_fraction_bits"] = bits;
    }
    for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
        const std::vector<uint32_t>& indices = mesh.attribute(attribute).singular_indices;
        if (!indices.empty()) root[kSingularIndices[static_cast<size_t>(attribute)]] = indices;
    }
    root["provenance"] =
        nlohmann::ordered_json::parse(asset.provenance_json.empty() ? "{}" : asset.provenance_json);
    return json_text(root, 2) + "\n";
}

std::vector<uint32_t> read_singular_indices(const Metadata& metadata, Attribute attribute,
                                            uint32_t num_components, size_t num_singular_values) {
    const char* const key = kSingularIndices[static_cast<size_t>(attribute)];
    std::vector<uint32_t> indices;
    if (!metadata.root().contains(key)) return indices;
    // No index can be above that of the last value. Without values there are no indices.
    const double last =
        num_singular_values > 0 ? static_cast<double>(num_singular_values) - 1.0 : 0;
    for (const double number : metadata.numbers(key, num_components, 0.0, last)) {
        const auto index = static_cast<uint32_t>(number);
        if (index != number || (!indices.empty() && index <= indices.back())) {
            throw_bad_input("{}: metadata: '{}': expected ascending indices, got {}",
                            metadata.file(), key, number);
        }
        indices.push_back(index);
    }
    return indices;
}

}  // namespace paim
