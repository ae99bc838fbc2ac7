// The JSON metadata of a .paim.
#include "paim/format/paim/paim_metadata.h"

#include <nlohmann/json.hpp>

#include <iterator>

#include "paim/base/error.h"
#include "paim/base/json_text.h"
#include "paim/codec/codecs.h"
#include "paim/codec/section_row.h"

namespace paim {

namespace {

constexpr const char* kSingularIndices[] = {"geometry_singular_indices",
                                            "transfer_singular_indices", "singular_indices"};
static_assert(std::size(kSingularIndices) == kNumAttributes);

bool has_floor(const CodedMesh& mesh) {
    return !mesh.root_motion.empty() && mesh.num_following < mesh.topology.num_vertices;
}

const TransferNames& transfer_names(TransferKind kind) {
    return kTransferNames[static_cast<size_t>(kind)];
}

const char* transfer_kind(const CodedMesh& mesh) {
    const TransferNames& names = transfer_names(mesh.layout.kind);
    if (mesh.root_motion.empty()) return names.in_scene;
    return has_floor(mesh) ? names.local_on_floor : names.local;
}

// The codec and its numbers.
void add_codec(const TransferModel& transfer, nlohmann::ordered_json& json) {
    if (const std::string_view codec = transfer.codec_name(); is_named_in_files(codec)) {
        json["codec"] = codec;
    }
    for (const NamedNumber& number : transfer.numbers()) json[number.name] = *number.value;
}

void add_singular_indices(const CodedMesh& mesh, Attribute attribute,
                          nlohmann::ordered_json& json) {
    const std::vector<uint32_t>& indices = mesh.attribute(attribute).singular_indices;
    if (!indices.empty()) json[kSingularIndices[static_cast<size_t>(attribute)]] = indices;
}

nlohmann::ordered_json gloss_json(const Asset& asset) {
    const CodedMesh& mesh = asset.moving();
    const CodedGloss& gloss = *mesh.gloss;
    nlohmann::ordered_json json;
    json["rows"] = gloss.num_rows;
    if (const CodedMesh* still = asset.still(); still != nullptr && still->gloss) {
        json["still_rows"] = still->gloss->num_rows;
        if (still->gloss->frame_turns.num_points > 0) json["still_frame_turns"] = true;
    }
    if (gloss.frame_turns.num_points > 0) json["frame_turns"] = true;
    json["bands"] = gloss.layout.in_bands;
    json["out_bands"] = gloss.layout.out_bands;
    json["channels"] = gloss.layout.channels;
    add_codec(*gloss.transfer, json);
    json["components"] = gloss.transfer->matrix.num_components;
    add_singular_indices(mesh, Attribute::gloss, json);
    return json;
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
    if (mesh.layout.kind == TransferKind::glossy) root["out_bands"] = mesh.layout.out_bands;
    root["channels"] = mesh.layout.channels;
    if (asset.vertex_order == VertexOrder::cache) root["vertex_order"] = "local";
    add_codec(*mesh.transfer, root);
    root["geometry_components"] = mesh.positions.num_components;
    root["transfer_components"] = mesh.transfer->matrix.num_components;
    if (const uint32_t bits = mesh.positions.fraction_bits; bits > 0) {
        root["geometry_fraction_bits"] = bits;
    }
    add_singular_indices(mesh, Attribute::geometry, root);
    add_singular_indices(mesh, Attribute::transfer, root);
    if (mesh.gloss) root["gloss"] = gloss_json(asset);
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
