// Reference images on the CPU.
// Based on: Henri Gouraud, Continuous Shading of Curved Surfaces, 1971
#include "paim/render/render.h"

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

VisiblePoints find_visible(const Topology& topology, std::span<const Vec3f> positions,
                           const Camera& camera, int width, int height) {
    PAIM_CHECK(camera.eye.allFinite());
    const RayScene scene(topology, positions);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    VisiblePoints visible{width, height, {}};
    visible.hits.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
    parallel_for(static_cast<size_t>(height), 4, [&](size_t begin, size_t end) {
        size_t pixel = begin * static_cast<size_t>(width);
        for (size_t y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x, ++pixel) {
                const Vec3f direction = camera.ray_direction(
                    (static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                    (static_cast<float>(y) + 0.5f) / static_cast<float>(height), aspect);
                visible.hits[pixel] = scene.intersect_first(camera.eye, direction)
                                          .value_or(Hit{0.0f, kNoTriangle, 0.0f, 0.0f});
            }
        }
    });
    return visible;
}

Image interpolate_image(const VisiblePoints& visible, const Topology& topology,
                        std::span<const Vec3f> radiance) {
    PAIM_CHECK_EQ(radiance.size(), topology.num_vertices);
    Image image(visible.width, visible.height);
    for (size_t pixel = 0; pixel < visible.hits.size(); ++pixel) {
        const Hit& hit = visible.hits[pixel];
        if (hit.triangle == kNoTriangle) continue;
        const Triangle& t = topology.triangles[hit.triangle];
        const float w = 1.0f - hit.u - hit.v;
        image.pixels[pixel] = w * radiance[t[0]] + hit.u * radiance[t[1]] + hit.v * radiance[t[2]];
    }
    return image;
}

std::vector<Image> render_images(const Topology& topology, std::span<const Vec3f> positions,
                                 std::span<const std::vector<Vec3f>> radiance, const Camera& camera,
                                 int width, int height) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    const VisiblePoints visible = find_visible(topology, positions, camera, width, height);
    std::vector<Image> images;
    for (const auto& values : radiance) {
        images.push_back(interpolate_image(visible, topology, values));
    }
    return images;
}

}  // namespace paim
