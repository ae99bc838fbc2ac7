// How many components the motion of every single vertex needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/encode/svd/principal_components.h"

namespace paim {

// Components are chosen by the energy of all vertices together. In this sum a hand that waves on a
// body that walks counts for nothing, and nor does a small part next to a large one, although one
// sees them move. So the motion that dropped components take from a vertex is limited, too: an RMS
// distance over the poses.
struct MotionLimits {
    // Dropped motion may be this share of the vertex's motion within its group, which is the RMS
    // over the poses of its distance from its mean, both relative to the mean of the group in a pose.
    // So walking does not make limbs stand still. A vertex loses no larger share of its motion.
    // Vertices that move more than a hundred times as far as the median vertex, and as can be seen,
    // are in no mean.
    double lost_share = 0.1;
    // Scene units; dropped motion up to this is too small to be seen.
    double invisible = 0.0;
    // [V] numbers of groups (motion_groups()); empty: the whole mesh is one.
    std::vector<uint32_t> group = {};
};

// The fewest components with which every vertex is within one of the two limits.
// rows      planes x, y and z of V rows each; read three times
// vertices  that count, ascending
uint32_t components_for_motion(const RowSource& rows, const PrincipalComponents& components,
                               std::span<const uint32_t> vertices, const MotionLimits& limits);

// Memory of components_for_motion() for V vertices and P poses.
uint64_t components_for_motion_bytes(uint64_t num_vertices, uint64_t num_poses,
                                     uint64_t num_threads);

}  // namespace paim
