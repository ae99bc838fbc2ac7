// Reference images on the CPU.
// Based on: Henri Gouraud, Continuous Shading of Curved Surfaces, 1971
#include "paim/render/render.h"

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/trace/ray_scene.h"

namespace paim {

std::vector<Image> render_images(const Topology& topology, std::span<const Vec3f> positions,
                                 std::span<const std::vector<Vec3f>> radiance, const Camera& camera,
                                 int width, int height) {
    for (const auto& values : radiance) PAIM_CHECK_EQ(values.size(), positions.size());
    PAIM_CHECK(camera.eye.allFinite());
    const RayScene scene(topology, positions);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    std::vector<Image> images(radiance.size(), Image(width, height));
    parallel_for(static_cast<size_t>(height), 4, [&](size_t begin, size_t end) {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < width; ++x) {
                const Vec3f direction = camera.ray_direction(
                    (static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(height), aspect);
                const auto hit = scene.intersect_first(camera.eye, direction);
                if (!hit) continue;
                const Triangle& t = topology.triangles[hit->triangle];
                const float w = 1.0f - hit->u - hit->v;
                for (size_t light = 0; light < images.size(); ++light) {
                    const auto& values = radiance[light];
                    images[light].at(x, y) =
                        w * values[t[0]] + hit->u * values[t[1]] + hit->v * values[t[2]];
                }
            }
        }
    });
    return images;
}

}  // namespace paim
