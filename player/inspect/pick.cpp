// Meets a ray with all triangles, one after another.
// Based on: Möller and Trumbore 1997 (see the header)
#include "player/inspect/pick.h"

#include <array>
#include <limits>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim::player {

namespace {

Vec3d corner(const PickSurface& surface, uint32_t vertex) {
    const size_t num_vertices = surface.topology->num_vertices;
    return {double{surface.positions[vertex]}, double{surface.positions[num_vertices + vertex]},
            double{surface.positions[2 * num_vertices + vertex]}};
}

struct Meeting {
    double distance = std::numeric_limits<double>::infinity();  // in lengths of the direction
    double second = 0.0, third = 0.0;                           // barycentric
    uint32_t triangle = 0;
};

// Written so that a number that is not finite is a miss. Triangles without area and planes along the
// ray have a volume of 0, and numbers divided by it.
bool meets(const Vec3d& origin, const Vec3d& direction, const PickSurface& surface,
           const Triangle& triangle, Meeting& meeting) {
    const Vec3d a = corner(surface, triangle[0]);
    const Vec3d ab = corner(surface, triangle[1]) - a;
    const Vec3d ac = corner(surface, triangle[2]) - a;
    const Vec3d across = direction.cross(ac);
    const double volume = ab.dot(across);
    const Vec3d from_a = origin - a;
    meeting.second = from_a.dot(across) / volume;
    const Vec3d along = from_a.cross(ab);
    meeting.third = direction.dot(along) / volume;
    meeting.distance = ac.dot(along) / volume;
    return meeting.second >= 0.0 && meeting.third >= 0.0 && meeting.second + meeting.third <= 1.0 &&
           meeting.distance > 0.0;
}

Meeting nearest_of(const Vec3d& origin, const Vec3d& direction, const PickSurface& surface,
                   size_t first, size_t end) {
    Meeting nearest, meeting;
    for (size_t f = first; f < end; ++f) {
        if (!meets(origin, direction, surface, surface.topology->triangles[f], meeting)) continue;
        if (!(meeting.distance < nearest.distance)) continue;
        nearest = meeting;
        nearest.triangle = static_cast<uint32_t>(f);
    }
    return nearest;
}

Meeting nearest_in(const Vec3d& origin, const Vec3d& direction, const PickSurface& surface) {
    constexpr size_t kTrianglesAtOnce = 16384;
    const size_t num_triangles = surface.topology->triangles.size();
    PAIM_CHECK_EQ(surface.positions.size(), size_t{3} * surface.topology->num_vertices);
    std::vector<Meeting> pieces((num_triangles + kTrianglesAtOnce - 1) / kTrianglesAtOnce);
    parallel_for(num_triangles, kTrianglesAtOnce, [&](size_t first, size_t end) {
        pieces[first / kTrianglesAtOnce] = nearest_of(origin, direction, surface, first, end);
    });
    Meeting nearest;
    for (const Meeting& piece : pieces) {
        if (piece.distance < nearest.distance) nearest = piece;
    }
    return nearest;
}

// The corner of the hit triangle that is nearest to the hit; the first of equally near ones.
uint32_t nearest_corner(const PickSurface& surface, const Triangle& triangle, const Vec3d& hit) {
    uint32_t nearest = triangle[0];
    for (const uint32_t vertex : triangle) {
        if ((corner(surface, vertex) - hit).norm() < (corner(surface, nearest) - hit).norm()) {
            nearest = vertex;
        }
    }
    return nearest;
}

}  // namespace

Ray ray_through_pixel(const Camera& camera, float u, float v, float aspect) {
    return {camera.eye, camera.ray_direction(u, v, aspect)};
}

std::optional<SurfaceHit> pick(const Ray& ray, std::span<const PickSurface> parts) {
    const Vec3d origin = ray.origin.cast<double>();
    const Vec3d direction = ray.direction.cast<double>().normalized();
    Meeting nearest;
    std::optional<SurfaceHit> hit;
    for (size_t part = 0; part < parts.size(); ++part) {
        const Meeting meeting = nearest_in(origin, direction, parts[part]);
        if (!(meeting.distance < nearest.distance)) continue;
        nearest = meeting;
        const Triangle& triangle = parts[part].topology->triangles[meeting.triangle];
        hit =
            SurfaceHit{static_cast<uint32_t>(part), meeting.triangle,
                       nearest_corner(parts[part], triangle, origin + meeting.distance * direction),
                       Vec3d(1.0 - meeting.second - meeting.third, meeting.second, meeting.third)
                           .cast<float>(),
                       meeting.distance};
    }
    return hit;
}

}  // namespace paim::player
