// Bakes a sequence into memory, and measures errors of approximations to the truth.
#pragma once

#include <Eigen/Core>

#include "compressor/bake/bake_options.h"
#include "paim/mesh/pose_source.h"

namespace paim::study {

// Data matrices (E3) of the transfer and of its noise: rows plane-major, a column a pose.
struct BakedMatrices {
    Eigen::MatrixXf transfer;
    Eigen::MatrixXf noise;
    uint64_t num_rays = 0;  // traced
};

// Bakes the first num_poses poses.
BakedMatrices bake_matrices(const PoseSource& source, const BakeOptions& options,
                            uint32_t num_poses);

// Measures errors to a bake of many rays. The noise of that bake is known, and subtracted from the
// errors.
class Truth {
  public:
    explicit Truth(BakedMatrices truth);

    // Relative RMS error of the transfer.
    double error(const Eigen::MatrixXf& approximation) const;

    // The quantile of the errors (L2 norm over coefficients) of all vertices in all poses. It
    // includes the noise of the truth.
    double vertex_error(const Eigen::MatrixXf& approximation, uint32_t num_vertices,
                        double share) const;

    // RMS error of the changes from pose to pose, relative to those changes. NaN for one pose.
    double flicker(const Eigen::MatrixXf& approximation) const;

  private:
    BakedMatrices truth_;
    double energy_, change_energy_;  // without noise
    double noise_energy_, change_noise_;
};

}  // namespace paim::study
