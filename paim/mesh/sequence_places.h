// Vertices that lie at the same places in all poses of a sequence, but for outliers.
#pragma once

#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <vector>

#include "paim/mesh/usual_bounds.h"

namespace paim {

// Poses that are compared first: 0 and, of three or more, two more at a third and at two thirds. An
// outlier (mesh/outliers.h) is in a quarter of the poses at most, so that most are not broken.
std::vector<uint32_t> reference_poses(uint32_t num_poses);

// Two vertices share a place if they coincide in every pose but those in which one of them is an
// outlier: they are farther apart than the mesh is large. As for outliers (mesh/outliers.h), this is
// in fewer than three poses never so, and for no vertex in more than about a quarter of the poses.
// The size of the mesh is the median of the diagonals of the reference poses, or that of the middle
// of the pose, if it is larger (mesh/usual_bounds.h). Of the two vertices the one that is farther
// from the middle is the outlier. It is taken to lie with the lowest vertex with which it shares its
// place in the references. (Where these are several that part in other poses, such as lips that the
// references have closed, this may part it from the right one.)
class SequencePlaces {
  public:
    struct Reference {
        std::span<const Vec3d> positions;  // [V] finite; only used by the constructor
        UsualBounds bounds;
    };
    // references  the poses reference_poses(num_poses)
    SequencePlaces(uint32_t num_poses, std::span<const Reference> references);

    // Adds a pose that is not a reference. Poses may come in any order, and from several threads.
    // positions  [V] finite
    void add(std::span<const Vec3d> positions, const UsualBounds& bounds);

    // [V] The lowest vertex with which each shares its place; empty if no two vertices share one.
    // Call it once, after all poses.
    std::vector<uint32_t> finish();

    // [V] The places in the first pose; empty if it has no outliers among vertices that share places.
    const std::vector<uint32_t>& first_places() const { return first_places_; }
    // Edges of the first pose that are longer than this have an outlier at one end.
    double longest_edge() const { return longest_edge_; }

  private:
    std::vector<uint32_t> with_outliers(std::span<const Vec3d> positions, const UsualBounds& bounds,
                                        const std::vector<uint32_t>& places);
    double limit(const UsualBounds& bounds) const;
    void find_homes(std::span<const Reference> references,
                    std::span<const std::vector<uint32_t>> places);

    uint32_t most_outliers_;      // of a vertex
    double size_ = 0.0;           // of the mesh; 0: there are no outliers
    std::vector<uint32_t> base_;  // [V] places that are shared in all references, with outliers
    // [V] The vertex with which each usually shares its place.
    std::vector<uint32_t> homes_;
    std::vector<uint32_t> first_places_;
    double longest_edge_ = std::numeric_limits<double>::infinity();

    std::mutex mutex_;                      // guards the following
    std::vector<uint32_t> exact_, places_;  // in all poses so far: without and with outliers
    std::vector<uint32_t> num_outliers_;    // [V], or empty: in how many poses each is one
};

}  // namespace paim
