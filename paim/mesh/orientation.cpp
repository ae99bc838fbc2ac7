// Closed parts of a mesh that face inwards.
// Based on: van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983
#include "paim/mesh/orientation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/check.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/face_edges.h"
#include "paim/mesh/places.h"
#include "paim/mesh/sets.h"

namespace paim {

namespace {

// Volumes below this share of the sum of the volumes below their faces are those of flat parts.
constexpr double kFlatVolume = 1e-9;

struct MeshPart {
    std::vector<uint32_t> triangles;
    Bounds bounds;
    double volume = 0.0;  // six times
    double sum = 0.0;     // of the absolute volumes that it is the sum of
    bool is_closed = true;

    bool has_volume() const { return is_closed && std::abs(volume) > kFlatVolume * sum; }
};

class MeshParts {
  public:
    MeshParts(const Topology& topology, std::span<const Vec3f> positions)
        : topology_(topology), positions_(positions) {
        split();
        for (MeshPart& part : parts_) measure(part);
    }

    std::vector<InwardPart> inward() const {
        std::vector<InwardPart> found;
        for (const MeshPart& part : parts_) {
            if (!part.has_volume() || part.volume > 0.0 || num_around(part) % 2 == 1) continue;
            InwardPart& entry = found.emplace_back();
            entry.triangles = part.triangles;
            entry.first_vertex = topology_.num_vertices;
            for (const uint32_t f : part.triangles) {
                for (const uint32_t v : topology_.triangles[f]) {
                    entry.first_vertex = std::min(entry.first_vertex, v);
                }
            }
        }
        return found;
    }

  private:
    // Joins faces at edges; a face with an edge of another kind opens its part.
    void split() {
        const size_t num_faces = topology_.triangles.size();
        Sets faces(num_faces);
        std::vector<uint32_t> odd;  // faces
        const auto join = [&](std::span<const FaceEdge> edges, bool runs_on) {
            if (edges.size() == 2 && runs_on) return faces.join(edges[0].face, edges[1].face);
            for (const FaceEdge& edge : edges) odd.push_back(edge.face);
        };
        std::vector<FaceEdge> open;
        for_each_edge(face_edges(topology_), {}, [&](std::span<const FaceEdge> edges) {
            if (edges.size() == 1) {
                open.push_back(edges[0]);
            } else {
                join(edges, edges[0].vertices[0] != edges[1].vertices[0]);
            }
        });
        const std::vector<uint32_t> places = first_at_position(positions_);
        for_each_edge(std::move(open), places, [&](std::span<const FaceEdge> edges) {
            join(edges, edges.size() == 2 && run_opposite(edges[0], edges[1], places));
        });
        std::vector<uint32_t> part_of(num_faces);
        for (uint32_t f = 0; f < num_faces; ++f) {
            const uint32_t first = faces.lowest(f);
            if (first == f) {
                part_of[f] = static_cast<uint32_t>(parts_.size());
                parts_.emplace_back();
            }
            part_of[f] = part_of[first];
            parts_[part_of[f]].triangles.push_back(f);
        }
        for (const uint32_t f : odd) parts_[part_of[f]].is_closed = false;
    }

    Vec3d corner(uint32_t f, size_t i) const {
        return positions_[topology_.triangles[f][i]].cast<double>();
    }

    void measure(MeshPart& part) const {
        if (!part.is_closed) return;
        const Vec3d origin = corner(part.triangles[0], 0);
        for (const uint32_t f : part.triangles) {
            for (const uint32_t v : topology_.triangles[f]) part.bounds.extend(positions_[v]);
            const double volume =
                (corner(f, 0) - origin).dot((corner(f, 1) - origin).cross(corner(f, 2) - origin));
            part.volume += volume;
            part.sum += std::abs(volume);
        }
    }

    // Number of the other parts around this one.
    size_t num_around(const MeshPart& part) const {
        const Vec3f point = positions_[topology_.triangles[part.triangles[0]][0]];
        return static_cast<size_t>(
            std::count_if(parts_.begin(), parts_.end(), [&](const MeshPart& p) {
                return &p != &part && p.has_volume() &&
                       (point.array() >= p.bounds.lower.array()).all() &&
                       (point.array() <= p.bounds.upper.array()).all() && is_around(p, point);
            }));
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
    std::span<const Vec3f> positions_;
    std::vector<MeshPart> parts_;
};

}  // namespace

std::vector<InwardPart> find_inward_parts(const Topology& topology,
                                          std::span<const Vec3f> positions) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    return MeshParts(topology, positions).inward();
}

void turn_triangles(std::span<const uint32_t> triangles, Topology& topology) {
    for (const uint32_t f : triangles) {
        std::swap(topology.triangles[f][1], topology.triangles[f][2]);
    }
}

}  // namespace paim
