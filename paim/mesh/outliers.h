// Positions far beyond the rest of a vertex's own motion, such as one broken frame of a simulation.
// Based on: Hampel, The Influence Curve and Its Role in Robust Estimation, 1974 (the median, and
//           deviations from it in units of their own quantile)
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

// A vertex in one pose.
struct PositionOutlier {
    uint32_t vertex = 0;
    uint32_t pose = 0;
    Vec3f position = Vec3f::Zero();  // as baked
    // Interpolated from the nearest poses, before and after, in which the vertex is no outlier.
    Vec3f usual = Vec3f::Zero();

    // From where the vertex usually is, scene units.
    double distance() const { return (position.cast<double>() - usual.cast<double>()).norm(); }
};

// All outliers of a sequence, by pose, then by vertex.
class PositionOutliers {
  public:
    PositionOutliers() = default;
    explicit PositionOutliers(std::vector<PositionOutlier> outliers);

    bool empty() const { return outliers_.empty(); }
    std::span<const PositionOutlier> all() const { return outliers_; }
    std::span<const PositionOutlier> of_pose(uint32_t pose) const;
    std::vector<uint32_t> poses() const;  // that have outliers, ascending

    // Puts the usual positions into rows [first, first + rows.size()) of the planes x, y and z of a
    // pose.
    void replace(uint32_t pose, uint32_t num_vertices, uint64_t first, std::span<float> rows) const;

    // The same outliers with other numbers of vertices.
    // old_vertex  [V] the number here of each vertex there
    PositionOutliers reordered(std::span<const uint32_t> old_vertex) const;

    uint64_t size_bytes() const { return outliers_.size() * sizeof(PositionOutlier); }

  private:
    std::vector<PositionOutlier> outliers_;
};

// Reads rows [first, first + count) of the planes x, y and z of a pose, 3 · V rows. Thread-safe.
using ReadPositionRows =
    std::function<void(uint32_t pose, uint64_t first, uint64_t count, float* rows)>;

// For vertex v let m be the median of its position over the poses, axis by axis, d_p = |x_p − m|,
// and s the 75 % quantile of d_p. D is the diagonal of the box round m ± s of all vertices. Pose p
// of the vertex is an outlier if
//   * d_p > D + 10 s: farther from the rest of its motion than the whole mesh is large, and
//   * a single step of more than D + 10 s leads there from the pose before the run of such poses,
//     and another from the run's last pose to the pose after it, where there are such poses. What
//     flies apart or walks away gets there in many small steps and is motion.
// Where D is 0, a point becomes a body, and nothing is an outlier.
// So an outlier is in at most a quarter of the poses. Two poses do not say which one is the outlier,
// so there are none in fewer than three.
// What happens to more than half of the vertices in more than two poses, and in more than a
// sixteenth of all, is motion, too, such as a cut to another place. Finally, there are no outliers
// where there would be more than kMaxOutliersPerVertex for each vertex, on average.
//
// counted  vertices that count, ascending (face_vertices())
// Memory: outliers_bytes(). The same outliers on any number of threads.
PositionOutliers find_outliers(uint32_t num_vertices, uint32_t num_poses,
                               std::span<const uint32_t> counted, const ReadPositionRows& read);

constexpr uint64_t kMaxOutliersPerVertex = 16;

// The most poses in which a vertex can be an outlier: those beyond the quantile s.
uint32_t most_outliers_of_vertex(uint32_t num_poses);

// Memory of find_outliers() without what it finds.
uint64_t outliers_bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t num_threads);

}  // namespace paim
