// Brute-force ray casting in double.
#include "tests/player/ray_cast.h"

#include <cmath>
#include <limits>

#include "paim/base/check.h"

namespace paim::player {

namespace {

struct Hit {
    double distance = std::numeric_limits<double>::infinity();
    Vec3d weights = Vec3d::Zero();
    const Triangle* triangle = nullptr;
};

void intersect(const Vec3d& origin, const Vec3d& direction, const Triangle& triangle,
               const std::vector<Vec3f>& positions, Hit& hit) {
    const Vec3d a = positions[triangle[0]].cast<double>();
    const Vec3d ab = positions[triangle[1]].cast<double>() - a;
    const Vec3d ac = positions[triangle[2]].cast<double>() - a;
    const Vec3d cross = direction.cross(ac);
    const double determinant = ab.dot(cross);
    if (std::abs(determinant) < 1e-14) return;
    const Vec3d offset = origin - a;
    const double u = offset.dot(cross) / determinant;
    const double v = direction.dot(offset.cross(ab)) / determinant;
    const double distance = ac.dot(offset.cross(ab)) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || distance <= 0.0 || distance >= hit.distance) return;
    hit = {distance, Vec3d(1.0 - u - v, u, v), &triangle};
}

}  // namespace

Image ray_cast(const Topology& topology, const std::vector<Vec3f>& positions,
               const std::vector<Vec3f>& values, const Camera& camera, int width, int height,
               const Vec3f& background) {
    Image image(width, height, background);
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec3d direction =
                camera
                    .ray_direction((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                   (static_cast<float>(y) + 0.5f) / static_cast<float>(height),
                                   aspect)
                    .cast<double>();
            Hit hit;
            for (const Triangle& triangle : topology.triangles) {
                intersect(camera.eye.cast<double>(), direction, triangle, positions, hit);
            }
            if (hit.triangle == nullptr) continue;
            Vec3d value = Vec3d::Zero();
            for (int corner = 0; corner < 3; ++corner) {
                const uint32_t v = (*hit.triangle)[static_cast<size_t>(corner)];
                value += hit.weights[corner] * values[v].cast<double>();
            }
            image.at(x, y) = value.cast<float>();
        }
    }
    return image;
}

Difference compare(const Image& reference, const Image& image) {
    PAIM_CHECK_EQ(reference.pixels.size(), image.pixels.size());
    double sum = 0.0, sum_off = 0.0;
    size_t num_off = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Vec3f off = (image.pixels[i] - reference.pixels[i]).cwiseAbs();
        sum += static_cast<double>(reference.pixels[i].cwiseAbs().sum());
        sum_off += static_cast<double>(off.sum());
        if (!(off.maxCoeff() <= 2.0f / 255.0f)) ++num_off;
    }
    return {sum_off / sum, static_cast<double>(num_off) / static_cast<double>(image.pixels.size())};
}

}  // namespace paim::player
