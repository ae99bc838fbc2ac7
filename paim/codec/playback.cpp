// Plays an asset on the CPU.
#include "paim/codec/playback.h"

#include <utility>

#include "paim/base/check.h"
#include "paim/mesh/bounds.h"

namespace paim {

namespace {

Vec3f centre_of(const CodedMesh& mesh) {
    const std::vector<float> planes = mesh.positions.mean_floats();
    const size_t num_vertices = mesh.topology.num_vertices;
    Bounds bounds;
    for (size_t v = 0; v < num_vertices; ++v) {
        bounds.extend(Vec3f(planes[v], planes[num_vertices + v], planes[2 * num_vertices + v]));
    }
    return bounds.empty() ? Vec3f(Vec3f::Zero()) : bounds.center();
}

}  // namespace

Playback::Playback(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {
    PAIM_CHECK(asset_ != nullptr && !asset_->parts.empty());
    for (const CodedMesh& mesh : asset_->parts) parts_.emplace_back(mesh);
}

Playback::Part::Part(const CodedMesh& coded)
    : mesh(coded), centre(centre_of(coded)), player(coded.transfer->make_player(coded.layout)) {}

void Playback::set_light(const LightField& light) {
    for (Part& part : parts_) {
        part.light = light.at(part.centre, static_cast<int>(part.mesh.layout.in_bands));
        part.is_lit = false;
    }
}

void Playback::update(double time, const DecodeLimits& limits) {
    for (Part& part : parts_) update(part, part.mesh.num_poses() == 1 ? 0.0 : time, limits);
}

void Playback::update(Part& part, double time, const DecodeLimits& limits) {
    const bool moved = part.time != time;
    if (moved || part.limits.geometry_components != limits.geometry_components) {
        part.decoder.decode(part.mesh.positions, time, limits.geometry_components, part.positions);
    }
    if (part.light.bands > 0 && (moved || !part.is_lit || part.limits != limits)) {
        part.player->light(time, limits, part.light, part.mesh.albedo, part.radiance);
        part.is_lit = true;
    }
    part.time = time;
    part.limits = limits;
}

std::span<const float> Playback::positions(size_t part) const {
    PAIM_CHECK_LT(part, parts_.size());
    return parts_[part].positions;
}

std::span<const Vec3f> Playback::radiance(size_t part) const {
    PAIM_CHECK_LT(part, parts_.size());
    return parts_[part].radiance;
}

}  // namespace paim
