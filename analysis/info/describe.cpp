// Describes a .paim file or a .bake directory.
#include "analysis/info/describe.h"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/info/describe_texture.h"
#include "paim/base/json_text.h"
#include "paim/cli/root_motion_json.h"
#include "paim/codec/section_row.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/rates.h"
#include "paim/metrics/singular_value_error.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

ordered_json describe_matrix(const LowRank& matrix) {
    ordered_json json;
    json["components"] = matrix.num_components;
    json["precision"] = precision_name(matrix.precision);
    json["theory_error"] = theory_error(matrix);
    json["energy_error"] = energy_error(matrix);
    const size_t shown = std::min<size_t>(matrix.singular_values.size(), 10);
    json["largest_singular_values"] =
        std::vector<double>(matrix.singular_values.begin(),
                            matrix.singular_values.begin() + static_cast<ptrdiff_t>(shown));
    return json;
}

ordered_json describe_gloss(const Asset& asset) {
    const CodedMesh& mesh = asset.moving();
    const CodedGloss& gloss = *mesh.gloss;
    ordered_json json;
    json["vertices"] = gloss.num_rows;
    json["bands"] = gloss.layout.in_bands;
    json["out_bands"] = gloss.layout.out_bands;
    json["channels"] = gloss.layout.channels;
    json["transfer_codec"] = gloss.transfer->codec_name();
    for (const NamedNumber& number : gloss.transfer->numbers()) json[number.name] = *number.value;
    json["transfer"] = describe_matrix(gloss.transfer->matrix);
    return json;
}

ordered_json describe_paim(const std::filesystem::path& path) {
    const Asset asset = read_paim(path);
    const CodedMesh& mesh = asset.moving();
    ordered_json json;
    json["file"] = path.string();
    json["kind"] = "paim";
    json["name"] = asset.name;
    json["size_bytes"] = std::filesystem::file_size(path);
    json["num_vertices"] = mesh.topology.num_vertices;
    json["num_triangles"] = mesh.topology.triangles.size();
    json["num_poses"] = asset.num_poses();
    json["frames_per_second"] = asset.frames_per_second;
    json["bands"] = mesh.layout.in_bands;
    json["channels"] = mesh.layout.channels;
    json["origin"] = {asset.origin.x(), asset.origin.y(), asset.origin.z()};
    cli::add_root_motion(json, mesh.root_motion);
    json["albedo"] = mesh.albedo.values.size() == 1 ? "uniform" : "per vertex";
    json["bits_per_vertex_per_pose"] = bits_per_vertex_per_pose(
        json["size_bytes"].get<uint64_t>(), mesh.topology.num_vertices, asset.num_poses());
    if (const CodedMesh* still = asset.still()) {
        json["scenery_vertices"] = still->topology.num_vertices;
        json["scenery_triangles"] = still->topology.triangles.size();
    }
    for (const CodedMesh& part : asset.parts) add_texture(part.texture, json);
    json["vertex_order"] = asset.vertex_order == VertexOrder::cache ? "local" : "baked";
    json["transfer_codec"] = mesh.transfer->codec_name();
    for (const NamedNumber& number : mesh.transfer->numbers()) json[number.name] = *number.value;
    json["geometry"] = describe_matrix(mesh.positions);
    json["transfer"] = describe_matrix(mesh.transfer->matrix);
    if (mesh.gloss) json["gloss"] = describe_gloss(asset);
    json["provenance"] = ordered_json::parse(asset.provenance_json);
    return json;
}

ordered_json describe_gloss(const BakeReader& bake) {
    const GlossIdentity& gloss = *bake.identity().gloss;
    ordered_json json;
    json["vertices"] = bake.gloss_rows().size();
    json["bands"] = gloss.layout.in_bands;
    json["out_bands"] = gloss.layout.out_bands;
    json["channels"] = gloss.layout.channels;
    for (const GlossMaterial& material : gloss.materials) json["brdfs"].push_back(material.brdf);
    if (bake.gloss_rows().empty()) return json;
    const PoseStatistics total = bake.gloss().total_statistics();
    json["relative_noise"] = total.relative_noise();
    json["transfer_rms_by_band"] = total.transfer_rms;
    json["noise_rms_by_band"] = total.noise_rms;
    return json;
}

ordered_json describe_bake(const std::filesystem::path& path) {
    const BakeReader bake(path);
    bake.verify_all();
    const BakeIdentity& identity = bake.identity();
    ordered_json json;
    json["file"] = path.string();
    json["kind"] = "bake";
    json["num_vertices"] = identity.num_vertices;
    json["num_triangles"] = identity.num_triangles;
    json["num_poses"] = bake.num_poses();
    json["first_pose"] = identity.poses.front().name;
    json["last_pose"] = identity.poses.back().name;
    json["bands"] = identity.layout.in_bands;
    json["channels"] = identity.layout.channels;
    json["sampler"] = identity.sampler;
    json["streams"] = identity.streams;
    json["rays"] = identity.rays;
    if (identity.transfer_error > 0.0) json["transfer_error"] = identity.transfer_error;
    json["seed"] = fmt::format("{:016x}", identity.seed);
    json["normals"] = identity.normals;
    json["bounces"] = identity.bounces;
    if (!identity.floor.empty()) json["floor"] = identity.floor;
    for (const auto& source : identity.still_meshes) json["static"].push_back(source.name);
    if (bake.still_mesh()) {
        json["scenery_vertices"] = bake.still_mesh()->topology.num_vertices;
        json["scenery_triangles"] = bake.still_mesh()->topology.triangles.size();
    }
    add_texture(bake.texture(), json);
    if (bake.still_mesh()) add_texture(bake.still_mesh()->texture, json);
    json["origin"] = {identity.origin.x(), identity.origin.y(), identity.origin.z()};
    cli::add_root_motion(json, identity.root_motion);
    const PoseStatistics total = bake.total_statistics();
    json["size_bytes"] = bake.size_bytes();
    json["rays_traced"] = total.rays;
    json["rays_blocked"] = total.occluded;
    json["vertices_without_normal"] = total.zero_normals;
    if (identity.transfer_error > 0.0) {
        json["vertices_above_transfer_error"] = total.above_target;
    }
    json["relative_noise"] = total.relative_noise();
    json["transfer_rms_by_band"] = total.transfer_rms;
    json["noise_rms_by_band"] = total.noise_rms;
    if (identity.gloss) json["gloss"] = describe_gloss(bake);
    return json;
}

// All digits if they are few, as those of an origin are.
std::string number_text(double value) {
    std::string exact = fmt::format("{}", value);
    return exact.size() <= 10 ? exact : fmt::format("{:.5g}", value);
}

void append_lines(const ordered_json& json, int indent, std::string& text) {
    for (const auto& [key, value] : json.items()) {
        std::string label = key;
        std::replace(label.begin(), label.end(), '_', ' ');
        text += fmt::format("{:{}}{}:", "", indent, label);
        if (value.is_object()) {
            text += '\n';
            append_lines(value, indent + 2, text);
        } else if (value.is_number_float()) {
            text += fmt::format(" {:.6g}\n", value.get<double>());
        } else if (value.is_array()) {
            for (const auto& entry : value) {
                text += ' ';
                text += entry.is_number() ? number_text(entry.get<double>()) : json_text(entry);
            }
            text += '\n';
        } else {
            text += fmt::format(" {}\n",
                                value.is_string() ? value.get<std::string>() : json_text(value));
        }
    }
}

}  // namespace

ordered_json describe(const std::filesystem::path& path) {
    return std::filesystem::is_directory(path) ? describe_bake(path) : describe_paim(path);
}

std::string as_text(const ordered_json& description) {
    std::string text;
    append_lines(description, 0, text);
    return text;
}

}  // namespace paim
