// Pictures of baked poses by traced light.
#include "analysis/reference/traced_pictures.h"

#include <algorithm>
#include <array>
#include <utility>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// Pictures of the mean of both halves, and of half their difference.
struct MeanAndNoise {
    Vec3f mean, noise;
};
MeanAndNoise combine(const Vec3f& a, const Vec3f& b) {
    return {0.5f * (a + b), 0.5f * (a - b)};
}

// Of the random numbers of a light, other ones for each.
uint64_t seed_of(size_t light) {
    return 1 + light;
}

std::vector<Vec3f> scene_normals(const DecodedPose& pose, std::vector<float> planes) {
    transform_planes(pose.root.rotation.toRotationMatrix(), Vec3d::Zero(), planes,
                     pose.num_following);
    return from_planes(planes);
}

}  // namespace

// A pose as it is drawn, and what its rays meet.
struct TracedReference::Pose {
    std::vector<VisiblePoints> visible;  // [views]
    std::unique_ptr<TracedScene> scene;
    uint32_t number;
    uint32_t num_vertices;  // that move
    uint32_t num_triangles;
};

TracedReference::TracedReference(const BakeReader& bake, const Stage& stage, uint32_t rays)
    : bake_(bake), stage_(stage) {
    for (const NamedLight& light : stage.lights()) samplers_.emplace_back(light.map);
    if (bake.still_mesh()) {
        const BakedStillMesh& still = *bake.still_mesh();
        const DecodedPose pose = baked_pose(bake, 0, bake.read_pose(0));
        const std::vector<Vec3f> all = stage.place(pose);
        still_mesh_.topology = still.topology;
        still_mesh_.albedo = still.albedo;
        still_mesh_.positions.assign(
            all.begin() + static_cast<ptrdiff_t>(bake.identity().num_vertices), all.end());
        still_mesh_.normals = from_planes(still.pose.normals);
        still_scene_ = std::make_unique<TracedScene>(still_mesh_, TracedMesh());
    }
    for (size_t light = 0; light < samplers_.size(); ++light) {
        lights_.emplace_back(samplers_[light], rays, seed_of(light));
    }
    still_lights_.resize(samplers_.size());
    for (size_t light = 0; light < samplers_.size(); ++light) light_still_mesh(light);
}

TracedReference::~TracedReference() = default;

uint32_t TracedReference::most_rays() const {
    uint32_t most = 0;
    for (const DirectLight& light : lights_) most = std::max(most, light.rays());
    return most;
}

void TracedReference::set_rays(size_t light, uint32_t rays) {
    lights_[light] = DirectLight(samplers_[light], rays, seed_of(light));
    light_still_mesh(light);
}

void TracedReference::light_still_mesh(size_t light) {
    if (!still_scene_) return;
    still_lights_[light] =
        still_scene_->light_vertices(lights_[light], settings_for(light, kStillMeshPose));
}

const VertexLight* TracedReference::still_light(size_t light) const {
    return still_scene_ ? &still_lights_[light] : nullptr;
}

TraceSettings TracedReference::settings_for(size_t light, uint32_t pose) const {
    return {bake_.identity().bounces, seed_of(light), pose};
}

VertexLight TracedReference::light_moving(const Pose& pose, size_t light) const {
    return pose.scene->light_vertices(lights_[light], settings_for(light, pose.number),
                                      still_light(light));
}

ReferencePictures TracedReference::trace(uint32_t p, TracedAt at) const {
    BakedPose baked = bake_.read_pose(p);
    TracedMesh mesh;
    mesh.topology = bake_.topology();
    mesh.albedo = bake_.albedo();
    std::vector<float> normals = std::move(baked.normals);
    const DecodedPose decoded = baked_pose(bake_, p, std::move(baked));
    mesh.normals = scene_normals(decoded, std::move(normals));
    mesh.positions = stage_.place(decoded);
    Pose pose{stage_.look(mesh.positions), nullptr, p, bake_.identity().num_vertices,
              bake_.identity().num_triangles};
    mesh.positions.resize(pose.num_vertices);
    pose.scene = std::make_unique<TracedScene>(std::move(mesh), still_mesh_);
    ReferencePictures out;
    if (at == TracedAt::pixels) {
        trace_pixels(pose, out);
        return out;
    }
    std::vector<std::vector<Vec3f>> means, noises;
    for (size_t light = 0; light < samplers_.size(); ++light) {
        const VertexLight moving = light_moving(pose, light);
        std::array<std::vector<Vec3f>, 2> halves{moving.half(0), moving.half(1)};
        if (const VertexLight* still = still_light(light)) {
            for (size_t h = 0; h < 2; ++h) {
                const std::vector<Vec3f> of_still = still->half(h);
                halves[h].insert(halves[h].end(), of_still.begin(), of_still.end());
            }
        }
        std::vector<Vec3f> mean, noise;
        for (uint32_t v = 0; v < halves[0].size(); ++v) {
            const MeanAndNoise both = combine(halves[0][v], halves[1][v]);
            mean.push_back(both.mean.cwiseProduct(stage_.albedo().at(v)));
            noise.push_back(both.noise.cwiseProduct(stage_.albedo().at(v)));
        }
        means.push_back(std::move(mean));
        noises.push_back(std::move(noise));
    }
    out.pictures = stage_.draw(pose.visible, means);
    out.noise = stage_.draw(pose.visible, noises);
    return out;
}

void TracedReference::trace_pixels(const Pose& pose, ReferencePictures& out) const {
    std::vector<VertexLight> moving;
    for (size_t light = 0; light < samplers_.size(); ++light) {
        // Needed only for light that bounces off the vertices.
        moving.push_back(bake_.identity().bounces > 0 ? light_moving(pose, light) : VertexLight());
    }
    const Topology& topology = stage_.topology();
    for (const VisiblePoints& visible : pose.visible) {
        std::vector<TracedPoint> points[2];  // of the moving and of the still mesh
        std::vector<size_t> pixels[2];
        for (size_t pixel = 0; pixel < visible.hits.size(); ++pixel) {
            const Hit& hit = visible.hits[pixel];
            if (hit.triangle == kNoTriangle) continue;
            const size_t part = hit.triangle < pose.num_triangles ? 0 : 1;
            const uint32_t first = part == 0 ? 0 : pose.num_triangles;
            points[part].push_back({hit.triangle - first, hit.u, hit.v});
            pixels[part].push_back(pixel);
        }
        for (size_t light = 0; light < samplers_.size(); ++light) {
            Image mean(visible.width, visible.height), noise(visible.width, visible.height);
            const auto fill = [&](size_t part, const std::vector<LightHalves>& halves) {
                for (size_t j = 0; j < halves.size(); ++j) {
                    const size_t pixel = pixels[part][j];
                    const Hit& hit = visible.hits[pixel];
                    const Triangle& t = topology.triangles[hit.triangle];
                    const Vec3f albedo = (1.0f - hit.u - hit.v) * stage_.albedo().at(t[0]) +
                                         hit.u * stage_.albedo().at(t[1]) +
                                         hit.v * stage_.albedo().at(t[2]);
                    const MeanAndNoise both = combine(halves[j][0], halves[j][1]);
                    mean.pixels[pixel] = both.mean.cwiseProduct(albedo);
                    noise.pixels[pixel] = both.noise.cwiseProduct(albedo);
                }
            };
            fill(0, pose.scene->light_points(points[0], lights_[light],
                                             settings_for(light, pose.number), moving[light],
                                             still_light(light)));
            if (still_scene_) {
                fill(1, still_scene_->light_points(points[1], lights_[light],
                                                   settings_for(light, kStillMeshPose),
                                                   still_lights_[light]));
            }
            out.pictures.push_back(std::move(mean));
            out.noise.push_back(std::move(noise));
        }
    }
}

}  // namespace paim
