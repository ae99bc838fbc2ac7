// The root motion of a pose sequence: how the body as a whole travels and turns.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

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

// The rigid transform that takes the points `from` closest to `to`, in squared distances where most
// points move with the body, and in distances for points farther off than one and a half times the median:
// limbs that swing, and outliers, hardly turn it. Where points do not decide a rotation, as on a
// line, it is the one nearest to the identity.
// from, to  of the same size (checked), finite
// Based on: Kabsch, A Solution for the Best Rotation to Relate Two Sets of Vectors, 1976; Huber,
//           Robust Estimation of a Location Parameter, 1964
RigidTransform fit_rigid(std::span<const Vec3d> from, std::span<const Vec3d> to);

// The same without rotation.
RigidTransform fit_translation(std::span<const Vec3d> from, std::span<const Vec3d> to);

// Fits vertices of faces of every pose, 5,000 at most, to those of the first one. Local coordinates
// are those of the first pose from its centre. What is taken out is what leaves the fewest principal
// components that matter (a thousandth of the body's size). Of two that leave as many it is the
// simpler one, unless the other leaves less than half of the squared distances from the mean. An outlier counts as if it were only as far as the body is
// large. Reads every pose once, on all threads. Transforms are rounded to 2⁻²² of a radian and of
// the body's size, so that files store few digits.
// returns  [P]; empty if the choice, or this rule, takes nothing out
// on_pose  called after each pose, from several threads at once
RootMotion find_root_motion(const PoseSource& source, RootMotionChoice choice,
                            const std::function<void()>& on_pose = {});

}  // namespace paim
