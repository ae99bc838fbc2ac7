// The faces round one vertex.
// Based on: Bærentzen and Aanæs 2005 (see the header); E. G. Gilbert, An Iterative Procedure for
//           Computing the Minimum of a Quadratic Form on a Convex Set, 1966
#include "compressor/bake/vertex_fan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "paim/mesh/normals.h"

namespace paim {

namespace {

// A normal whose component along the mean of the faces is above this points to their back.
constexpr double kBack = -0.1;

// Squared distances of a direction from two faces count as equal within this share.
constexpr double kSameDistance = 1e-12;

// Steps towards the most open direction. Few are needed unless faces are almost opposite.
constexpr int kMaxSteps = 1000;

double angle_between(const Vec3d& a, const Vec3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

VertexFan::VertexFan(const Topology& topology, std::span<const Vec3f> positions,
                     std::span<const uint32_t> places, uint32_t v,
                     std::span<const uint32_t> triangles, const Vec3f& normal)
    : triangles_(triangles.begin(), triangles.end()) {
    std::sort(triangles_.begin(), triangles_.end());
    connect(collect(topology, positions, places, v, triangles), normal);
    find_edges();
}

std::vector<VertexFan::Face> VertexFan::collect(const Topology& topology,
                                                std::span<const Vec3f> positions,
                                                std::span<const uint32_t> places, uint32_t v,
                                                std::span<const uint32_t> triangles) const {
    const auto place = [&](uint32_t u) { return places.empty() ? u : places[u]; };
    std::vector<Face> faces;
    // The first of the faces that lie on each other, by the places of their other corners.
    std::map<std::pair<uint32_t, uint32_t>, bool> known;
    for (const uint32_t index : triangles) {
        const Triangle& t = topology.triangles[index];
        Face face;
        face.normal = face_normal(positions[t[0]], positions[t[1]], positions[t[2]]);
        if (face.normal.isZero(0.0)) continue;
        size_t corner = 0;
        while (place(t[corner]) != place(v)) ++corner;
        for (size_t i = 0; i < 2; ++i) {
            const uint32_t u = t[(corner + 1 + i) % 3];
            face.ends[i] = place(u);
            face.edges[i] =
                (positions[u].cast<double>() - positions[v].cast<double>()).normalized();
        }
        face.is_own = t[corner] == v;
        const std::pair<uint32_t, uint32_t> key = std::minmax(face.ends[0], face.ends[1]);
        if (known.emplace(key, true).second) faces.push_back(face);
    }
    return faces;
}

// Keeps the faces that are connected with those of the vertex itself, and turns them to one side.
void VertexFan::connect(std::vector<Face> all, const Vec3f& normal) {
    struct Visit {
        size_t face;
        size_t end;  // 0 or 1
    };
    std::map<uint32_t, std::vector<Visit>> at_end;  // by place
    for (size_t f = 0; f < all.size(); ++f) {
        for (const size_t end : {size_t{0}, size_t{1}})
            at_end[all[f].ends[end]].push_back({f, end});
    }
    std::vector<bool> reached(all.size(), false);
    for (size_t first = 0; first < all.size(); ++first) {
        if (reached[first] || !all[first].is_own) continue;
        const size_t begin = faces_.size();
        std::vector<std::pair<size_t, double>> open{{first, 1.0}};  // faces and their signs
        reached[first] = true;
        Vec3d sum = Vec3d::Zero();
        double weights = 0.0;
        while (!open.empty()) {
            const auto [f, sign] = open.back();
            open.pop_back();
            Face face = all[f];
            face.normal *= sign;
            const double angle = angle_between(face.edges[0], face.edges[1]);
            sum += angle * face.normal;
            weights += angle;
            faces_.push_back(face);
            for (const size_t end : {size_t{0}, size_t{1}}) {
                const std::vector<Visit>& visits = at_end[face.ends[end]];
                if (visits.size() != 2) continue;
                const Visit& other = visits[0].face == f ? visits[1] : visits[0];
                if (reached[other.face]) continue;
                reached[other.face] = true;
                open.emplace_back(other.face, other.end == end ? -sign : sign);
            }
        }
        if (sum.dot(normal.cast<double>()) < kBack * weights) {
            sum = -sum;
            for (size_t f = begin; f < faces_.size(); ++f) faces_[f].normal *= -1.0;
        }
        normal_ += sum;
    }
}

void VertexFan::find_edges() {
    std::map<uint32_t, Edge> edges;
    for (const Face& face : faces_) {
        for (const size_t end : {size_t{0}, size_t{1}}) {
            Edge& edge = edges.try_emplace(face.ends[end], Edge{face.edges[end], Vec3d::Zero()})
                             .first->second;
            edge.normal += face.normal;
        }
    }
    for (const auto& [place, edge] : edges) edges_.push_back(edge);
}

double VertexFan::clearance(const Vec3d& direction) const {
    double least = 1.0;
    for (const Face& face : faces_) least = std::min(least, face.normal.dot(direction));
    return least;
}

// The largest clearance is the distance of the origin from the convex hull of the normals, and its
// direction that of the nearest point of the hull. The point moves from normal to normal: each time
// to the nearest point of the line to the normal that it rises above least.
Vec3d VertexFan::most_open_direction(double smallest) const {
    if (faces_.empty()) return Vec3d::Zero();
    Vec3d point = faces_[0].normal;
    for (int step = 0; step < kMaxSteps; ++step) {
        const double length = point.norm();  // no clearance is larger
        if (length < smallest) return Vec3d::Zero();
        const Face& lowest =
            *std::min_element(faces_.begin(), faces_.end(), [&](const Face& a, const Face& b) {
                return a.normal.dot(point) < b.normal.dot(point);
            });
        if (lowest.normal.dot(point) >= 0.9 * length * length) return point / length;
        const Vec3d line = lowest.normal - point;
        point += std::clamp(-point.dot(line) / line.squaredNorm(), 0.0, 1.0) * line;
    }
    return Vec3d::Zero();
}

bool VertexFan::hides(const Vec3d& direction) const {
    double nearest = std::numeric_limits<double>::infinity();  // squared distance
    bool hidden = false;
    const auto consider = [&](double squared_distance, bool is_behind) {
        if (squared_distance < (1.0 - kSameDistance) * nearest) {
            nearest = squared_distance;
            hidden = is_behind;
        } else if (squared_distance <= (1.0 + kSameDistance) * nearest) {
            hidden = hidden && is_behind;
        }
    };
    for (const Face& face : faces_) {
        const Vec3d out = face.edges[0].cross(face.edges[1]);  // of the face as it is wound
        if (out.cross(face.edges[0]).dot(direction) < 0.0) continue;
        if (face.edges[1].cross(out).dot(direction) < 0.0) continue;
        const double height = face.normal.dot(direction);
        consider(height * height, height < 0.0);
    }
    for (const Edge& edge : edges_) {
        if (edge.direction.dot(direction) <= 0.0) continue;
        consider(edge.direction.cross(direction).squaredNorm(), edge.normal.dot(direction) < 0.0);
    }
    // Otherwise the apex is nearest.
    if (std::isinf(nearest)) return normal_.dot(direction) < 0.0;
    return hidden;
}

}  // namespace paim
