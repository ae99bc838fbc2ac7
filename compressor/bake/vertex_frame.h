// The frame of a vertex, whose z axis is the normal, and coefficients that turn between it and the
// axes of the pose.
#pragma once

#include <span>
#include <vector>

#include "compressor/bake/direction_sampler.h"
#include "paim/sh/rotate.h"

namespace paim {

class VertexFrame {
  public:
    // bands   of the coefficients that are turned, 1 … sh::kMaxBands
    // normal  unit
    VertexFrame(int bands, const Vec3f& normal);

    // Sixteen directions of rays, from `first` on, in the frame.
    void directions_to_frame(const RaySet& rays, size_t first, float* x, float* y, float* z) const;

    // Turns outgoing coefficients of the frame, those named alone, to the axes of the pose.
    // coefficients  [K], of the bands of the frame
    // rows          [K][num_columns]
    // out           [O][num_columns], O coefficients of all bands of the outgoing ones; zero before
    void rows_to_pose(std::span<const int> coefficients, size_t num_columns, const double* rows,
                      double* out) const;

    // From the frame to the axes of the pose.
    const sh::Rotation& to_pose() const { return to_pose_; }

  private:
    Eigen::Matrix3d axes_;  // columns x, y, z
    sh::Rotation to_pose_;
};

}  // namespace paim
