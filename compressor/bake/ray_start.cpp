// Where the rays of each vertex start.
#include "compressor/bake/ray_start.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/places.h"

namespace paim {

namespace {

// Clearance (the sine of the angle above a face) with which the normal is good enough. A start that
// is four roundings off the vertex is then at least one off the face.
constexpr double kClear = 0.25;
// Clearance below which the directions in front of the faces are a slit, for which the offset of
// 1e-4 edges is no longer small.
constexpr double kSlit = 0.02;
// The largest offset where faces are steep, times the shortest edge.
constexpr double kFar = 1e-2;
// A place with more vertices than this is that of a mesh that has collapsed to a point, not of a
// seam, and pairs of its vertices would be too many.
constexpr size_t kMaxSharing = 64;
constexpr size_t kFansPerPiece = 64;

// Lists of numbers, one list a key, in one array.
class Lists {
  public:
    // count  calls add(key, number) for each
    template <typename ForEach>
    Lists(size_t num_keys, const ForEach& for_each) : begins_(num_keys + 1, 0) {
        for_each([&](uint32_t key, uint32_t) { ++begins_[key + 1]; });
        for (size_t k = 0; k < num_keys; ++k) begins_[k + 1] += begins_[k];
        numbers_.resize(begins_.back());
        std::vector<size_t> at(begins_.begin(), begins_.end() - 1);
        for_each([&](uint32_t key, uint32_t number) { numbers_[at[key]++] = number; });
    }
    std::span<const uint32_t> operator[](size_t key) const {
        return std::span(numbers_).subspan(begins_[key], begins_[key + 1] - begins_[key]);
    }

  private:
    std::vector<size_t> begins_;
    std::vector<uint32_t> numbers_;
};

// Looks for the starts of the vertices of one pose.
class StartSearch {
  public:
    StartSearch(const Topology& topology, std::span<const Vec3f> positions,
                std::span<const Vec3f> normals, const RayOffsetRule& rule)
        : topology_(topology),
          positions_(positions),
          normals_(normals),
          rule_(rule),
          faces_(measure_vertex_faces(topology, positions, normals)),
          places_(first_at_position(positions)),
          num_sharing_(places_.size(), 0) {
        for (size_t v = 0; v < places_.size(); ++v) {
            num_sharing_[places_[v]] += faces_[v].any() ? 1 : 0;
        }
    }

    // Moves the vertices whose normal is good enough. Returns the others that have faces and a
    // normal, and those that share their place.
    std::vector<uint32_t> move_easy(std::vector<Vec3f>& origins) const {
        std::vector<uint32_t> others;
        for (uint32_t v = 0; v < positions_.size(); ++v) {
            if (!faces_[v].any() || normals_[v].isZero(0.0f)) continue;
            const double clearance = std::max(faces_[v].lowest_cosine, -faces_[v].highest_cosine);
            if (clearance < kClear || shares(v)) {
                others.push_back(v);
            } else {
                origins[v] = moved(v, normals_[v].cast<double>(), distance(v, clearance));
            }
        }
        return others;
    }

    // Numbers of the faces at the places of these vertices, a list a place.
    Lists faces_at(const std::vector<uint32_t>& vertices) const {
        std::vector<bool> wanted(positions_.size(), false);
        for (const uint32_t v : vertices) wanted[place(v)] = true;
        return Lists(positions_.size(), [&](const auto& add) {
            for (uint32_t f = 0; f < topology_.triangles.size(); ++f) {
                for (const uint32_t v : topology_.triangles[f]) {
                    if (wanted[place(v)]) add(place(v), f);
                }
            }
        });
    }

    // Moves a vertex by the fan of its faces; returns the fan if there is no way off the vertex.
    std::unique_ptr<const VertexFan> move_by_fan(uint32_t v, const Lists& faces,
                                                 Vec3f& origin) const {
        const std::span<const uint32_t> all = faces[place(v)];
        std::vector<uint32_t> own_first(all.begin(), all.end());
        std::stable_partition(own_first.begin(), own_first.end(), [&](uint32_t f) {
            const Triangle& t = topology_.triangles[f];
            return t[0] == v || t[1] == v || t[2] == v;
        });
        auto fan = std::make_unique<const VertexFan>(topology_, positions_, places_, v, own_first,
                                                     normals_[v]);
        Vec3d direction = normals_[v].cast<double>();
        if (fan->clearance(direction) < kClear) direction = fan->most_open_direction(kSlit);
        if (direction.isZero(0.0)) return fan;
        const double clearance = fan->clearance(direction);
        const double far = distance(v, clearance);
        if (clearance < kClear && far > kFar * faces_[v].shortest) return fan;
        origin = moved(v, direction, far);
        return nullptr;
    }

  private:
    // Whether other vertices of faces lie where this one does.
    bool shares(uint32_t v) const {
        if (places_.empty()) return false;
        const uint32_t n = num_sharing_[places_[v]];
        return n > 1 && n <= kMaxSharing;
    }
    uint32_t place(uint32_t v) const { return shares(v) ? places_[v] : v; }

    double distance(uint32_t v, double clearance) const {
        return std::max(rule_.of_edge * faces_[v].shortest,
                        rule_.of_coordinate * faces_[v].rounding() / clearance);
    }
    Vec3f moved(uint32_t v, const Vec3d& direction, double distance) const {
        return (positions_[v].cast<double>() + distance * direction).cast<float>();
    }

    const Topology& topology_;
    std::span<const Vec3f> positions_, normals_;  // [V]
    const RayOffsetRule& rule_;
    std::vector<VertexFaces> faces_;     // [V]
    std::vector<uint32_t> places_;       // [V] or empty
    std::vector<uint32_t> num_sharing_;  // [V] vertices of faces, by place
};

}  // namespace

RayStarts::RayStarts(const Topology& topology, std::span<const Vec3f> positions,
                     std::span<const Vec3f> normals, const RayOffsetRule& rule)
    : origins_(positions.begin(), positions.end()) {
    PAIM_CHECK_EQ(normals.size(), positions.size());
    const StartSearch search(topology, positions, normals, rule);
    const std::vector<uint32_t> steep = search.move_easy(origins_);
    if (steep.empty()) return;
    const Lists faces = search.faces_at(steep);
    std::vector<std::unique_ptr<const VertexFan>> fans(steep.size());
    parallel_for(steep.size(), kFansPerPiece, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            fans[i] = search.move_by_fan(steep[i], faces, origins_[steep[i]]);
        }
    });
    for (size_t i = 0; i < steep.size(); ++i) {
        if (fans[i]) fans_.emplace_back(steep[i], std::move(fans[i]));
    }
}

RayStart RayStarts::operator[](size_t v) const {
    const auto at =
        std::lower_bound(fans_.begin(), fans_.end(), v,
                         [](const auto& entry, size_t key) { return entry.first < key; });
    const bool found = at != fans_.end() && at->first == v;
    return {origins_[v], found ? at->second.get() : nullptr};
}

uint32_t occluded_from(const RayScene& scene, const RayStart& start, const float* x, const float* y,
                       const float* z, uint32_t count, float* occluded) {
    if (start.fan == nullptr) return scene.occluded(start.origin, x, y, z, count, occluded);
    uint32_t num_occluded = 0;
    for (uint32_t j = 0; j < count; ++j) {
        const Vec3f direction(x[j], y[j], z[j]);
        const bool hit =
            start.fan->hides(direction.cast<double>()) ||
            scene.intersect_first(start.origin, direction, start.fan->triangles()).has_value();
        occluded[j] = hit ? 1.0f : 0.0f;
        num_occluded += hit ? 1 : 0;
    }
    return num_occluded;
}

}  // namespace paim
