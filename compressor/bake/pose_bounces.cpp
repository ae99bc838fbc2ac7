// Bounces of light in one pose.
#include "compressor/bake/pose_bounces.h"

#include <numeric>
#include <utility>

namespace paim {

namespace {

// Of the pose and, after it, the still mesh.
struct AllMeshes {
    Topology topology;
    std::vector<Vec3f> positions;

    explicit AllMeshes(const PoseBounces& bounces)
        : topology(bounces.rays.topology), positions(bounces.rays.pose.positions) {
        topology.append(bounces.still_mesh.topology);
        positions.insert(positions.end(), bounces.still_mesh.pose.positions.begin(),
                         bounces.still_mesh.pose.positions.end());
    }
};

uint64_t add_matte_bounces(const PoseBounces& bounces, const AllMeshes& all, uint32_t num_bounces,
                           std::array<std::vector<float>, 2>& halves, StillTerms* terms) {
    const PoseRays& rays = bounces.rays;
    std::vector<uint32_t> num_back_hits[2];
    for (auto& counts : num_back_hits) counts.resize(rays.num_vertices(), 0);
    BounceScene scene;
    scene.layout = bounces.layout;
    scene.num_vertices = rays.num_vertices();
    scene.albedo = bounces.albedo;
    scene.num_still_vertices = bounces.still_mesh.topology.num_vertices;
    scene.still_albedo = bounces.still_mesh.albedo;
    scene.still_terms = &bounces.still_terms.diffuse;
    scene.make_row = [&](size_t v, size_t half, TransportRow& row) {
        row.clear();
        if (rays.num_occluded[v] == 0) return;
        const RayStart start = rays.starts[v];
        HitTracer tracer(rays.scene, all.topology, all.positions);
        rays.rounds.for_each(
            v, [&](const DirectionSampler& sampler, const HalfKeys& keys, double weight) {
                tracer.trace(static_cast<uint32_t>(v), start, rays.pose.normals[v], sampler, keys,
                             static_cast<uint32_t>(half), weight);
            });
        num_back_hits[half][v] = tracer.num_back_hits();
        tracer.end(row);
    };
    BounceTerms bounced = add_bounces(scene, num_bounces, halves, terms != nullptr);
    if (terms != nullptr) terms->diffuse = std::move(bounced);
    uint64_t sum = 0;
    for (const auto& counts : num_back_hits) {
        sum = std::accumulate(counts.begin(), counts.end(), sum);
    }
    return sum;
}

}  // namespace

uint64_t add_bounces(const PoseBounces& bounces, uint32_t num_bounces,
                     std::array<std::vector<float>, 2>& halves,
                     std::array<std::vector<float>, 2>& gloss, StillTerms* terms) {
    const AllMeshes all(bounces);
    if (!bounces.gloss_layout) return add_matte_bounces(bounces, all, num_bounces, halves, terms);
    const GlossyBounceScene scene{
        bounces.rays,
        bounces.layout,
        *bounces.gloss_layout,
        {bounces.rays.num_vertices(), &bounces.albedo, &bounces.rows},
        {bounces.still_mesh.topology.num_vertices, &bounces.still_mesh.albedo, &bounces.still_rows},
        &bounces.still_terms.glossy,
        all.topology,
        all.positions};
    uint64_t num_back_hits = 0;
    std::vector<GlossyTerm> bounced =
        add_glossy_bounces(scene, num_bounces, halves, gloss, terms != nullptr, num_back_hits);
    if (terms != nullptr) terms->glossy = std::move(bounced);
    return num_back_hits;
}

}  // namespace paim
