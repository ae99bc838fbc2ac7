// The root motion of a pose sequence: how the body as a whole travels and turns.
#pragma once

#include <cstdint>
#include <functional>

#include "paim/mesh/pose_source.h"
#include "paim/mesh/root_motion.h"

namespace paim {

// What may be taken out of the poses.
enum class RootMotionChoice : uint32_t {
    automatic,    // what makes the poses much more alike
    none,         // nothing
    translation,  // positions
    rigid,        // positions and rotations
};

// Where local coordinates begin.
enum class LocalOrigin : uint32_t {
    centre,     // at the centre of the body
    reference,  // so that the pose that the others are fitted to is where it is in the scene. With a
                // floor, whose local coordinates are those of the scene, bounds stay what they are
};

// Fits vertices of faces of every pose, 5,000 at most, to those of the first one that has a size.
// What is taken out is what leaves the fewest principal components that matter (a thousandth of the
// body's size). Of two that leave as many it is the simpler one, unless the other leaves less than half of the squared distances from
// the mean. Rotations are taken out only if one of them is by 15 degrees or more: smaller ones
// follow the shape, and hardly turn transfer. An outlier counts as if it were only as far as the
// body is large, and a pose that jumps away from the path and back is no step of it. Reads every
// pose once, on all threads. Transforms are rounded to 2⁻²² of a radian and of the body's size, so
// that files store few digits.
// returns  [P]; empty if the choice, or this rule, takes nothing out
// on_pose  called after each pose, from several threads at once
RootMotion find_root_motion(const PoseSource& source, RootMotionChoice choice,
                            const std::function<void()>& on_pose = {},
                            LocalOrigin local_origin = LocalOrigin::centre);

}  // namespace paim
