// Looking at single vertices.
#include "player/vertex_probe.h"

#include <algorithm>

#include "paim/codec/rebuild_planes.h"
#include "player/inspect/lobe.h"
#include "player/inspect/pick.h"
#include "player/inspect/surface_colors.h"

namespace paim::player {

namespace {

float value_at(const StoredValues& values, size_t index) {
    float found = 0.0f;
    values.for_each(index, 1, [&](size_t, float value) { found = value; });
    return found;
}

Vec3f local_position(const CodedMesh& mesh, double time, uint32_t num_components, uint32_t vertex) {
    const LowRank& positions = mesh.positions;
    std::vector<float> weights;
    interpolate_weights(positions, time, weights);
    const uint32_t used = std::min(num_components, positions.num_components);
    Vec3f place;
    for (uint32_t axis = 0; axis < 3; ++axis) {
        const size_t index = size_t{axis} * positions.num_points + vertex;
        float sum = value_at(positions.mean, index);
        for (uint32_t k = 0; k < used; ++k) {
            sum += weights[k] * value_at(positions.components[k], index);
        }
        place[axis] = sum * positions.step(axis);
    }
    return place;
}

}  // namespace

std::optional<PickedVertex> VertexProbe::pick(double time, const DecodeLimits& limits,
                                              const Camera& camera, float x, float y,
                                              float aspect) {
    std::vector<std::vector<float>> positions(asset_->parts.size());
    std::vector<PickSurface> surfaces;
    PositionDecoder decoder;
    for (size_t j = 0; j < asset_->parts.size(); ++j) {
        const CodedMesh& mesh = asset_->parts[j];
        decoder.decode(mesh.positions, time, limits.geometry_components, positions[j]);
        move_to_scene(root_at(mesh.root_motion, time), positions[j], mesh.num_following);
        surfaces.push_back({&mesh.topology, positions[j]});
    }
    const auto hit = player::pick(ray_through_pixel(camera, x, y, aspect), surfaces);
    if (!hit) return std::nullopt;
    return PickedVertex{hit->part, hit->vertex};
}

Vec3f VertexProbe::position(double time, const DecodeLimits& limits,
                            const PickedVertex& vertex) const {
    const CodedMesh& mesh = asset_->parts[vertex.part];
    const Vec3f local = local_position(mesh, time, limits.geometry_components, vertex.vertex);
    if (vertex.vertex >= mesh.num_following) return local;
    return root_at(mesh.root_motion, time).to_scene(local.cast<double>()).cast<float>();
}

std::vector<float> VertexProbe::transfer(double time, const DecodeLimits& limits,
                                         const PickedVertex& vertex) {
    const Decoded wanted{vertex.part, time, limits};
    if (decoded_ != wanted) {
        decoded_.reset();
        MeshDecoder(asset_->parts[vertex.part]).decode(time, limits, pose_);
        decoded_ = wanted;
    }
    const std::vector<float> local =
        vertex_transfer(pose_.layout, pose_.transfer, vertex.vertex, kLuminance);
    const bool follows = vertex.vertex < pose_.num_following;
    if (!follows || !pose_.root.turns()) return local;
    // As a light, whose three channels are the same.
    LightCoefficients function{static_cast<int>(pose_.layout.in_bands), {}};
    for (const float value : local) function.values.emplace_back(Vec3f::Constant(value));
    function = turn(function, pose_.root.rotation.toRotationMatrix());
    std::vector<float> in_scene;
    for (const Vec3f& value : function.values) in_scene.push_back(value.x());
    return in_scene;
}

ErrorHistory::ErrorHistory(std::shared_ptr<const Asset> asset, const PickedVertex& vertex,
                           SurfaceView surface, const DecodeLimits& limits,
                           const LightCoefficients& light)
    : asset_(std::move(asset)),
      vertex_(vertex),
      surface_(surface),
      limits_(limits),
      errors_(asset_),
      values_(errors_, error_of(surface), vertex.part, vertex.vertex, limits) {
    errors_.set_light(DistantLight(light));
}

bool ErrorHistory::is_of(const std::shared_ptr<const Asset>& asset, const PickedVertex& vertex,
                         SurfaceView surface, const DecodeLimits& limits) const {
    return asset_ == asset && vertex_ == vertex && surface_ == surface && limits_ == limits;
}

}  // namespace paim::player
