// Closed parts of a mesh that face inwards.
// Based on: van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983
#include "paim/mesh/orientation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/check.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/face_edges.h"
#include "paim/mesh/far_vertices.h"
#include "paim/mesh/places.h"
#include "paim/mesh/sets.h"

namespace paim {

namespace {

// Volumes below this share of the sum of the volumes below their faces are those of flat parts.
constexpr double kFlatVolume = 1e-9;

// A part of the mesh: faces that are connected across edges.
struct MeshPart {
    std::vector<uint32_t> triangles;
    bool is_closed = true;
};

// Joins faces at edges; a face with an edge of another kind opens its part.
// places  [V] places that vertices share, or empty
std::vector<MeshPart> split(const Topology& topology, std::span<const uint32_t> places) {
    const size_t num_faces = topology.triangles.size();
    Sets faces(num_faces);
    std::vector<uint32_t> odd;  // faces
    const auto join = [&](std::span<const FaceEdge> edges, bool runs_on) {
        if (edges.size() == 2 && runs_on) return faces.join(edges[0].face, edges[1].face);
        for (const FaceEdge& edge : edges) odd.push_back(edge.face);
    };
    std::vector<FaceEdge> open;
    for_each_edge(face_edges(topology), {}, [&](std::span<const FaceEdge> edges) {
        if (edges.size() == 1) {
            open.push_back(edges[0]);
        } else {
            join(edges, edges[0].vertices[0] != edges[1].vertices[0]);
        }
    });
    for_each_edge(std::move(open), places, [&](std::span<const FaceEdge> edges) {
        join(edges, edges.size() == 2 && run_opposite(edges[0], edges[1], places));
    });
    std::vector<MeshPart> parts;
    std::vector<uint32_t> part_of(num_faces);
    for (uint32_t f = 0; f < num_faces; ++f) {
        const uint32_t first = faces.lowest(f);
        if (first == f) {
            part_of[f] = static_cast<uint32_t>(parts.size());
            parts.emplace_back();
        }
        part_of[f] = part_of[first];
        parts[part_of[f]].triangles.push_back(f);
    }
    for (const uint32_t f : odd) parts[part_of[f]].is_closed = false;
    return parts;
}

// The parts in one pose.
class PosedParts {
  public:
    PosedParts(const Topology& topology, const std::vector<MeshPart>& parts,
               std::span<const Vec3f> positions)
        : topology_(topology), parts_(parts), positions_(positions) {
        for (const MeshPart& part : parts) shapes_.push_back(measure(part));
    }

    // Whether the part is closed and has a volume.
    bool has_volume(size_t i) const { return shapes_[i].has_volume(); }

    // 1 if the part faces outwards, or is the wall of a cavity; −1 if it faces inwards; 0 if it has
    // no volume.
    int side(size_t i) const {
        const Shape& shape = shapes_[i];
        if (!shape.has_volume()) return 0;
        return shape.volume < 0.0 && num_around(i) % 2 == 0 ? -1 : 1;
    }

  private:
    struct Shape {
        Bounds bounds;
        double volume = 0.0;  // six times
        double sum = 0.0;     // of the absolute volumes that it is the sum of

        // Not of open parts, which are not measured.
        bool has_volume() const { return std::abs(volume) > kFlatVolume * sum; }
    };

    Vec3d corner(uint32_t f, size_t i) const {
        return positions_[topology_.triangles[f][i]].cast<double>();
    }

    Shape measure(const MeshPart& part) const {
        Shape shape;
        if (!part.is_closed) return shape;
        const Vec3d origin = corner(part.triangles[0], 0);
        for (const uint32_t f : part.triangles) {
            for (const uint32_t v : topology_.triangles[f]) shape.bounds.extend(positions_[v]);
            const double volume =
                (corner(f, 0) - origin).dot((corner(f, 1) - origin).cross(corner(f, 2) - origin));
            shape.volume += volume;
            shape.sum += std::abs(volume);
        }
        return shape;
    }

    // Number of the other parts around this one.
    size_t num_around(size_t i) const {
        const Vec3f point = positions_[topology_.triangles[parts_[i].triangles[0]][0]];
        size_t count = 0;
        for (size_t j = 0; j < parts_.size(); ++j) {
            const Bounds& bounds = shapes_[j].bounds;
            if (j != i && shapes_[j].has_volume() &&
                (point.array() >= bounds.lower.array()).all() &&
                (point.array() <= bounds.upper.array()).all() && is_around(parts_[j], point)) {
                ++count;
            }
        }
        return count;
    }

    // By the sum of the solid angles of its faces, which is ±4π inside and 0 outside.
    bool is_around(const MeshPart& part, const Vec3f& point) const {
        double sum = 0.0;
        for (const uint32_t f : part.triangles) {
            Vec3d to[3];
            for (size_t i = 0; i < 3; ++i)
                to[i] = (corner(f, i) - point.cast<double>()).normalized();
            sum += 2.0 * std::atan2(to[0].dot(to[1].cross(to[2])),
                                    1.0 + to[0].dot(to[1]) + to[1].dot(to[2]) + to[2].dot(to[0]));
        }
        return std::abs(sum) > 2.0 * kPi;
    }

    const Topology& topology_;
    const std::vector<MeshPart>& parts_;
    std::span<const Vec3f> positions_;
    std::vector<Shape> shapes_;  // of the parts
};

// The sides of all parts in one pose; 0 where vertices far from the others of their part decide.
std::vector<int> sides_of(const Topology& topology, const std::vector<MeshPart>& parts,
                          std::span<const Vec3f> positions, const PosedParts& posed) {
    std::vector<Vec3f> drawn_in(positions.begin(), positions.end());
    bool any = false;
    for (const MeshPart& part : parts) {
        if (!part.is_closed) continue;
        any = draw_in_far_vertices(topology, part.triangles, positions, drawn_in) || any;
    }
    std::vector<int> sides(parts.size());
    for (size_t i = 0; i < parts.size(); ++i) sides[i] = posed.side(i);
    if (!any) return sides;
    const PosedParts usual(topology, parts, drawn_in);
    for (size_t i = 0; i < parts.size(); ++i) {
        if (usual.side(i) == -sides[i]) sides[i] = 0;
    }
    return sides;
}

}  // namespace

std::vector<InwardPart> find_inward_parts(const Topology& topology,
                                          std::span<const std::vector<Vec3f>> poses,
                                          std::span<const uint32_t> places) {
    PAIM_CHECK(!poses.empty());
    for (const auto& positions : poses) PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    const std::vector<uint32_t> first_places =
        places.empty() ? first_at_position(poses[0])
                       : std::vector<uint32_t>(places.begin(), places.end());
    const std::vector<MeshPart> parts = split(topology, first_places);
    std::vector<bool> is_judged(parts.size());
    std::vector<int> sum(parts.size(), 0);
    for (const auto& positions : poses) {
        const PosedParts posed(topology, parts, positions);
        const std::vector<int> sides = sides_of(topology, parts, positions, posed);
        for (size_t i = 0; i < parts.size(); ++i) {
            if (&positions == &poses[0]) is_judged[i] = posed.has_volume(i);
            sum[i] += sides[i];
        }
    }
    std::vector<InwardPart> found;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (!is_judged[i] || sum[i] >= 0) continue;
        InwardPart& entry = found.emplace_back();
        entry.triangles = parts[i].triangles;
        entry.first_vertex = topology.num_vertices;
        for (const uint32_t f : entry.triangles) {
            for (const uint32_t v : topology.triangles[f]) {
                entry.first_vertex = std::min(entry.first_vertex, v);
            }
        }
    }
    return found;
}

void turn_triangles(std::span<const uint32_t> triangles, Topology& topology) {
    for (const uint32_t f : triangles) {
        std::swap(topology.triangles[f][1], topology.triangles[f][2]);
    }
}

}  // namespace paim
