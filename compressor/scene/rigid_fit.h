// The rigid transform between two sets of points, some of which do not move with the others.
// Based on: Kabsch, A Solution for the Best Rotation to Relate Two Sets of Vectors, 1976; Huber,
//           Robust Estimation of a Location Parameter, 1964
#pragma once

#include <span>
#include <vector>

#include "paim/mesh/root_motion.h"

namespace paim {

// Of to − from, each coordinate by itself. At least one point.
Vec3d median_difference(std::span<const Vec3d> from, std::span<const Vec3d> to);

// The rigid transform that takes the points `from` closest to `to`, in squared distances where most
// points move with the body, and in distances for points farther off than one and a half times the median:
// limbs that swing, and outliers, hardly turn it. Where points do not decide a rotation, as on a
// line, it is the one nearest to the identity.
// from, to  of the same size (checked), finite
RigidTransform fit_rigid(std::span<const Vec3d> from, std::span<const Vec3d> to);

// The mean translation of the points that are within size_of(from) of the median translation. All
// that moves with the body, limbs too, counts alike, so that translations add no components.
RigidTransform fit_translation(std::span<const Vec3d> from, std::span<const Vec3d> to);

}  // namespace paim
