// A sequence baked into memory, and how far an approximation of it is from the truth.
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

// The first num_poses poses.
BakedMatrices bake_matrices(const PoseSource& source, const BakeOptions& options,
                            uint32_t num_poses);

// Measures approximations against a bake of many rays, whose own noise is known and taken out.
class Truth {
  public:
    explicit Truth(BakedMatrices truth);

    // Relative RMS error of the transfer.
    double error(const Eigen::MatrixXf& approximation) const;

    // The error (L2 norm over its coefficients) that this share of all vertices of all poses stays
    // below. The truth's own noise counts.
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
