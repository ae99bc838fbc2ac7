// Positions far beyond the rest of a vertex's own motion.
// Based on: Hampel 1974 (see the header)
#include "paim/mesh/outliers.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "paim/base/parallel.h"
#include "paim/mesh/bounds.h"

namespace paim {

namespace {

// Values that are read at once, 4 MB.
constexpr uint64_t kValuesAtOnce = uint64_t{1} << 20;
// Vertices that a thread works on at once.
constexpr size_t kVerticesAtOnce = 64;

// The index of the 75 % quantile of this number of values.
uint64_t quantile_index(uint64_t num_values) {
    return 3 * (num_values - 1) / 4;
}

uint64_t vertices_per_block(uint64_t num_vertices, uint64_t num_poses) {
    const uint64_t most = kValuesAtOnce / (3 * std::max<uint64_t>(1, num_poses));
    return std::clamp<uint64_t>(most, 1, std::max<uint64_t>(1, num_vertices));
}

// The way of one vertex through the poses.
class Track {
  public:
    explicit Track(uint32_t num_poses) : positions_(num_poses), distances_(num_poses) {}

    Vec3f& operator[](uint32_t pose) { return positions_[pose]; }

    // Finds the median and the distances from it.
    void measure() {
        std::vector<float>& values = values_;
        values.resize(positions_.size());
        for (int axis = 0; axis < 3; ++axis) {
            std::transform(positions_.begin(), positions_.end(), values.begin(),
                           [axis](const Vec3f& x) { return x[axis]; });
            const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
            std::nth_element(values.begin(), middle, values.end());
            median_[axis] = double{*middle};
        }
        for (size_t p = 0; p < positions_.size(); ++p) {
            distances_[p] = (positions_[p].cast<double>() - median_).norm();
        }
        sorted_ = distances_;
        const auto quantile =
            sorted_.begin() + static_cast<ptrdiff_t>(quantile_index(sorted_.size()));
        std::nth_element(sorted_.begin(), quantile, sorted_.end());
        spread_ = *quantile;
    }

    const Vec3d& median() const { return median_; }
    double spread() const { return spread_; }  // s
    double farthest() const { return *std::max_element(distances_.begin(), distances_.end()); }

    // Appends the outliers of the vertex, after measure().
    void find(uint32_t vertex, double diagonal, std::vector<PositionOutlier>& outliers) const {
        const double limit = diagonal + 10.0 * spread_;
        const size_t before = outliers.size();
        const auto num_poses = static_cast<uint32_t>(positions_.size());
        for (uint32_t first = 0; first < num_poses; ++first) {
            if (!(distances_[first] > limit)) continue;
            uint32_t end = first + 1;
            while (end < num_poses && distances_[end] > limit) ++end;
            const bool jumps_there = first == 0 || step(first) > limit;
            const bool jumps_back = end == num_poses || step(end) > limit;
            for (uint32_t p = first; jumps_there && jumps_back && p < end; ++p) {
                outliers.push_back({vertex, p, positions_[p], Vec3f::Zero()});
            }
            first = end;
        }
        interpolate(std::span(outliers).subspan(before));
    }

  private:
    // From the pose before.
    double step(uint32_t p) const {
        return (positions_[p].cast<double>() - positions_[p - 1].cast<double>()).norm();
    }

    // found  all outliers of the vertex, at most a quarter of the poses
    void interpolate(std::span<PositionOutlier> found) const {
        for (size_t j = 0; j < found.size();) {
            size_t end = j + 1;
            while (end < found.size() && found[end].pose == found[end - 1].pose + 1) ++end;
            const uint32_t after = found[end - 1].pose + 1;
            const bool has_after = after < positions_.size();
            const uint32_t before = found[j].pose > 0 ? found[j].pose - 1 : after;
            const Vec3d from = positions_[before].cast<double>();
            const Vec3d to = has_after ? positions_[after].cast<double>().eval() : from;
            for (; j < end; ++j) {
                const double share =
                    before < after ? double(found[j].pose - before) / (after - before) : 0.0;
                found[j].usual = ((1.0 - share) * from + share * to).cast<float>();
            }
        }
    }

    std::vector<Vec3f> positions_;
    std::vector<double> distances_, sorted_;
    std::vector<float> values_;
    Vec3d median_ = Vec3d::Zero();
    double spread_ = 0.0;
};

// Reads the tracks of all vertices that count, block by block.
class Tracks {
  public:
    Tracks(uint32_t num_vertices, uint32_t num_poses, std::span<const uint32_t> counted,
           const ReadPositionRows& read)
        : num_vertices_(num_vertices), num_poses_(num_poses), counted_(counted), read_(read) {}

    // Calls use(piece, vertex, track) for every vertex that counts, on any thread. Vertices of
    // pieces ascend, and so do pieces; next(n) is called before the next n pieces.
    void for_each(const std::function<void(size_t num_pieces)>& next,
                  const std::function<void(size_t piece, uint32_t vertex, Track& track)>& use) {
        const auto block = static_cast<uint32_t>(vertices_per_block(num_vertices_, num_poses_));
        for (uint32_t first = 0; first < num_vertices_; first += block) {
            const uint32_t end = first + std::min(block, num_vertices_ - first);
            const auto begin = std::lower_bound(counted_.begin(), counted_.end(), first);
            const std::span<const uint32_t> vertices(begin,
                                                     std::lower_bound(begin, counted_.end(), end));
            if (vertices.empty()) continue;
            read_block(first, end - first);
            next((vertices.size() + kVerticesAtOnce - 1) / kVerticesAtOnce);
            parallel_for(vertices.size(), kVerticesAtOnce, [&](size_t from, size_t to) {
                Track track(num_poses_);
                for (size_t j = from; j < to; ++j) {
                    fill(vertices[j] - first, end - first, track);
                    track.measure();
                    use(from / kVerticesAtOnce, vertices[j], track);
                }
            });
        }
    }

  private:
    void read_block(uint32_t first, uint32_t count) {
        values_.resize(size_t{3} * num_poses_ * count);
        parallel_for(num_poses_, 1, [&](size_t p, size_t) {
            for (size_t axis = 0; axis < 3; ++axis) {
                read_(static_cast<uint32_t>(p), axis * num_vertices_ + first, count,
                      values_.data() + (3 * p + axis) * count);
            }
        });
    }

    void fill(size_t vertex, size_t count, Track& track) const {
        for (uint32_t p = 0; p < num_poses_; ++p) {
            const float* const x = values_.data() + size_t{3} * p * count + vertex;
            track[p] = {x[0], x[count], x[2 * count]};
        }
    }

    const uint32_t num_vertices_, num_poses_;
    const std::span<const uint32_t> counted_;
    const ReadPositionRows& read_;
    std::vector<float> values_;  // [P][3][vertices of the block]
};

// Of the box round the usual places of all vertices; nothing if no vertex can have an outlier.
std::optional<double> usual_diagonal(Tracks& tracks) {
    struct Piece {
        BoundsD box;
        double excess = 0.0;  // largest d_p − 10 s
    };
    std::vector<Piece> pieces;
    BoundsD box;
    double excess = 0.0;
    const auto add_up = [&] {
        for (const Piece& piece : pieces) {
            box.extend(piece.box);
            excess = std::max(excess, piece.excess);
        }
    };
    tracks.for_each(
        [&](size_t num_pieces) {
            add_up();
            pieces.assign(num_pieces, {});
        },
        [&](size_t j, uint32_t, Track& track) {
            const Vec3d spread = Vec3d::Constant(track.spread());
            pieces[j].box.extend(Vec3d(track.median() - spread));
            pieces[j].box.extend(Vec3d(track.median() + spread));
            pieces[j].excess = std::max(pieces[j].excess, track.farthest() - 10.0 * track.spread());
        });
    add_up();
    if (!(box.diagonal() > 0.0 && excess > box.diagonal())) return std::nullopt;
    return box.diagonal();
}

// Removes outliers of poses in which most of num_counted vertices are outliers, if there are many of
// these poses.
void remove_cuts(uint32_t num_poses, size_t num_counted, std::vector<PositionOutlier>& outliers) {
    std::vector<size_t> in_pose(num_poses, 0);
    for (const PositionOutlier& outlier : outliers) ++in_pose[outlier.pose];
    const auto is_most = [&](size_t count) { return 2 * count > num_counted; };
    const auto jumps = std::count_if(in_pose.begin(), in_pose.end(), is_most);
    if (jumps <= std::max<ptrdiff_t>(2, num_poses / 16)) return;
    std::erase_if(outliers, [&](const PositionOutlier& one) { return is_most(in_pose[one.pose]); });
}

}  // namespace

PositionOutliers::PositionOutliers(std::vector<PositionOutlier> outliers)
    : outliers_(std::move(outliers)) {
    std::sort(outliers_.begin(), outliers_.end(), [](const auto& a, const auto& b) {
        return std::pair(a.pose, a.vertex) < std::pair(b.pose, b.vertex);
    });
}

std::span<const PositionOutlier> PositionOutliers::of_pose(uint32_t pose) const {
    const auto [begin, end] =
        std::equal_range(outliers_.begin(), outliers_.end(), PositionOutlier{.pose = pose},
                         [](const auto& a, const auto& b) { return a.pose < b.pose; });
    return {begin, end};
}

std::vector<uint32_t> PositionOutliers::poses() const {
    std::vector<uint32_t> poses;
    for (const PositionOutlier& outlier : outliers_) {
        if (poses.empty() || poses.back() != outlier.pose) poses.push_back(outlier.pose);
    }
    return poses;
}

void PositionOutliers::replace(uint32_t pose, uint32_t num_vertices, uint64_t first,
                               std::span<float> rows) const {
    for (const PositionOutlier& outlier : of_pose(pose)) {
        for (uint64_t axis = 0; axis < 3; ++axis) {
            const uint64_t row = axis * num_vertices + outlier.vertex;
            if (row < first || row - first >= rows.size()) continue;
            rows[row - first] = outlier.usual[static_cast<int>(axis)];
        }
    }
}

PositionOutliers PositionOutliers::reordered(std::span<const uint32_t> old_vertex) const {
    if (empty()) return {};
    std::vector<uint32_t> new_vertex(old_vertex.size());
    for (size_t v = 0; v < old_vertex.size(); ++v) {
        new_vertex[old_vertex[v]] = static_cast<uint32_t>(v);
    }
    std::vector<PositionOutlier> outliers = outliers_;
    for (PositionOutlier& outlier : outliers) outlier.vertex = new_vertex[outlier.vertex];
    return PositionOutliers(std::move(outliers));
}

PositionOutliers find_outliers(uint32_t num_vertices, uint32_t num_poses,
                               std::span<const uint32_t> counted, const ReadPositionRows& read) {
    if (num_poses < 3) return {};
    Tracks tracks(num_vertices, num_poses, counted, read);
    const std::optional<double> diagonal = usual_diagonal(tracks);
    if (!diagonal) return {};
    std::vector<PositionOutlier> outliers;
    std::vector<std::vector<PositionOutlier>> pieces;
    const uint64_t most = kMaxOutliersPerVertex * counted.size();
    const auto collect = [&] {
        for (const auto& piece : pieces) {
            if (outliers.size() > most) break;
            outliers.insert(outliers.end(), piece.begin(), piece.end());
        }
    };
    tracks.for_each(
        [&](size_t num_pieces) {
            collect();
            pieces.assign(num_pieces, {});
        },
        [&](size_t j, uint32_t vertex, Track& track) { track.find(vertex, *diagonal, pieces[j]); });
    collect();
    if (outliers.size() > most) return {};
    remove_cuts(num_poses, counted.size(), outliers);
    return PositionOutliers(std::move(outliers));
}

uint32_t most_outliers_of_vertex(uint32_t num_poses) {
    return num_poses < 3 ? 0 : num_poses - 1 - static_cast<uint32_t>(quantile_index(num_poses));
}

uint64_t outliers_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_threads) {
    const uint64_t in_block = vertices_per_block(num_vertices, num_poses);
    const uint64_t track = num_poses * (4 * sizeof(float) + 2 * sizeof(double));
    // A quarter of the positions of a block at most are outliers.
    return in_block * num_poses * (3 * sizeof(float) + sizeof(PositionOutlier) / 4) +
           num_threads * track;
}

}  // namespace paim
