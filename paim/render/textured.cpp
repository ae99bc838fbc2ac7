// Coordinates at a pixel and its neighbours, and the image there.
#include "paim/render/textured.h"

#include <array>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

// Rays of a picture against the plane of one triangle.
class TrianglePlane {
  public:
    TrianglePlane(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& eye)
        : edge1_((b - a).cast<double>()),
          edge2_((c - a).cast<double>()),
          from_(eye.cast<double>() - a.cast<double>()) {}

    // Weights of the second and third vertex where the ray meets the plane, also outside the
    // triangle; not finite where it does not. Based on: Möller and Trumbore, Fast, Minimum Storage
    // Ray-Triangle Intersection, 1997
    Eigen::Vector2d weights(const Vec3d& direction) const {
        const Vec3d p = direction.cross(edge2_);
        const double scale = 1.0 / edge1_.dot(p);
        return {scale * from_.dot(p), scale * direction.dot(from_.cross(edge1_))};
    }

  private:
    Vec3d edge1_, edge2_, from_;
};

// Where a pixel is in an image, and how far its neighbours are.
struct Footprint {
    Vec2f place, per_x, per_y;
};

class Coordinates {
  public:
    Coordinates(const VisiblePoints& visible, const Camera& camera)
        : width_(static_cast<float>(visible.width)),
          height_(static_cast<float>(visible.height)),
          rows_(visible.height),
          camera_(camera) {}

    Footprint at(const TrianglePlane& plane, const std::array<Vec2f, 3>& corners, int x,
                 int y) const {
        const auto place = [&](int column, int row) -> Eigen::Vector2d {
            const Vec3f direction =
                camera_.ray_direction((static_cast<float>(column) + 0.5f) / width_,
                                      (static_cast<float>(row) + 0.5f) / height_, width_ / height_);
            const Eigen::Vector2d w = plane.weights(direction.cast<double>());
            const Eigen::Vector2d first = corners[0].cast<double>();
            return first + w[0] * (corners[1].cast<double>() - first) +
                   w[1] * (corners[2].cast<double>() - first);
        };
        // Pixels of pictures are drawn in squares of two, from the lower left corner.
        const int left = x - x % 2, upper = y - (rows_ - y) % 2;
        return {place(x, y).cast<float>(), (place(left + 1, y) - place(left, y)).cast<float>(),
                (place(x, upper + 1) - place(x, upper)).cast<float>()};
    }

  private:
    float width_, height_;
    int rows_;
    const Camera& camera_;
};

}  // namespace

void draw_texture(const VisiblePoints& visible, const Topology& topology,
                  std::span<const Vec3f> positions, const Camera& camera, const Texture& texture,
                  std::span<const MipPyramid> pyramids, std::span<const Vec3f> white_radiance,
                  Image& image) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    PAIM_CHECK_EQ(white_radiance.size(), topology.num_vertices);
    PAIM_CHECK_EQ(image.pixels.size(), visible.hits.size());
    const Coordinates coordinates(visible, camera);
    const auto columns = static_cast<size_t>(visible.width);
    parallel_for(visible.hits.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t pixel = begin; pixel < end; ++pixel) {
            const Hit& hit = visible.hits[pixel];
            if (hit.triangle >= texture.image_of_face.size()) continue;
            const size_t number = texture.image_of_face[hit.triangle];
            if (number == 0) continue;
            const Triangle& t = topology.triangles[hit.triangle];
            const Triangle& c = texture.corners[hit.triangle];
            const Footprint of = coordinates.at(
                TrianglePlane(positions[t[0]], positions[t[1]], positions[t[2]], camera.eye),
                {texture.coordinates[c[0]], texture.coordinates[c[1]], texture.coordinates[c[2]]},
                static_cast<int>(pixel % columns), static_cast<int>(pixel / columns));
            const MipPyramid& pyramid = pyramids[number - 1];
            const Vec3f color =
                pyramid.sample(of.place.x(), of.place.y(), pyramid.level(of.per_x, of.per_y));
            const Vec3f white = (1.0f - hit.u - hit.v) * white_radiance[t[0]] +
                                hit.u * white_radiance[t[1]] + hit.v * white_radiance[t[2]];
            image.pixels[pixel] =
                color.cwiseProduct(texture.factors[number - 1]).cwiseProduct(white);
        }
    });
}

}  // namespace paim
