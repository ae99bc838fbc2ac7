// The gloss of an asset as an asset whose transfer it is.
#include "paim/codec/gloss_asset.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/json_text.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// Members in the order in which readers have them.
using Json = nlohmann::json;

Json provenance_of(const Asset& asset) {
    return Json::parse(asset.provenance_json.empty() ? "{}" : asset.provenance_json);
}

// The values of these points, in their order.
// values  [planes][N]
StoredValues at_points(const StoredValues& values, size_t num_points,
                       std::span<const uint32_t> points) {
    return std::visit(
        [&](const auto& all) {
            std::remove_cvref_t<decltype(all)> chosen;
            chosen.reserve(all.size() / num_points * points.size());
            for (size_t first = 0; first < all.size(); first += num_points) {
                for (const uint32_t n : points) chosen.push_back(all[first + n]);
            }
            return StoredValues(std::move(chosen));
        },
        values.values());
}

LowRank at_points(LowRank matrix, std::span<const uint32_t> points) {
    if (matrix.num_points == 0) return matrix;
    matrix.mean = at_points(matrix.mean, matrix.num_points, points);
    for (StoredValues& component : matrix.components) {
        component = at_points(component, matrix.num_points, points);
    }
    matrix.num_points = static_cast<uint32_t>(points.size());
    return matrix;
}

CodedMesh gloss_mesh(const CodedMesh& whole) {
    const CodedGloss& gloss = *whole.gloss;
    CodedMesh mesh;
    mesh.albedo = gloss.tint;
    mesh.layout = gloss.layout;
    mesh.transfer = gloss.transfer;
    mesh.frame_turns = gloss.frame_turns;
    mesh.root_motion = whole.root_motion;
    mesh.num_following = whole.num_following;
    if (gloss.vertices.empty()) {
        mesh.topology = whole.topology;
        mesh.positions = whole.positions;
        return mesh;
    }
    mesh.topology = faces_among(whole.topology, gloss.vertices);
    mesh.positions = at_points(whole.positions, gloss.vertices);
    // Glossy vertices of faces follow the root motion.
    mesh.num_following = kAllVertices;
    return mesh;
}

void join(CodedMesh gloss, std::span<const uint32_t> vertices, CodedMesh& whole) {
    CodedGloss& joined = whole.gloss.emplace();
    joined.layout = gloss.layout;
    joined.num_rows = gloss.topology.num_vertices;
    joined.transfer = std::move(gloss.transfer);
    joined.tint = std::move(gloss.albedo);
    joined.frame_turns = std::move(gloss.frame_turns);
    PAIM_CHECK_EQ(vertices.size(), size_t{joined.num_rows});
    if (joined.num_rows < whole.topology.num_vertices) {
        joined.vertices.assign(vertices.begin(), vertices.end());
        return;
    }
    // Two meshes with the same faces have the same order.
    for (uint32_t r = 0; r < vertices.size(); ++r) PAIM_CHECK_EQ(vertices[r], r);
}

}  // namespace

Asset gloss_asset(const Asset& whole) {
    PAIM_CHECK(whole.moving().gloss.has_value());
    Asset asset;
    asset.parts.clear();
    for (const CodedMesh& mesh : whole.parts) {
        if (mesh.gloss) asset.parts.push_back(gloss_mesh(mesh));
    }
    asset.origin = whole.origin;
    asset.frames_per_second = whole.frames_per_second;
    // The rows of some vertices are in no order that their faces tell.
    asset.vertex_order = whole.vertex_order;
    asset.complete = whole.complete;
    asset.name = whole.name;
    const Json provenance = provenance_of(whole);
    if (provenance.contains("gloss")) asset.provenance_json = json_text(provenance["gloss"]);
    return asset;
}

void join_gloss(Asset gloss, std::span<const uint32_t> vertices, std::span<const uint32_t> still,
                Asset& whole) {
    Json provenance = provenance_of(whole);
    provenance["gloss"] = provenance_of(gloss);
    whole.provenance_json = json_text(provenance);
    if (CodedMesh* const still_gloss = gloss.still()) {
        PAIM_CHECK(whole.still() != nullptr);
        join(std::move(*still_gloss), still, *whole.still());
    }
    join(std::move(gloss.moving()), vertices, whole.moving());
}

}  // namespace paim
