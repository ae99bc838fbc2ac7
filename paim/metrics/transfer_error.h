// How far a decoded transfer is from the bake, and how far it is expected to be from the truth.
// Based on: Efron, The Estimation of Prediction Error: Covariance Penalties and Cross-Validation,
//           2004 (docs/metrics.md)
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <vector>

#include "paim/metrics/band_power.h"
#include "paim/transfer/layout.h"

namespace paim {

// Sums of squares over all values of a band, not weighted.
struct TransferBandEnergy {
    double baked = 0.0;      // ‖y‖²
    double noise = 0.0;      // ‖d‖², as much as the bake's error ‖n‖² is expected to have
    double deviation = 0.0;  // ‖t̂ − y‖²
    double passed = 0.0;     // tr cov(t̂, n): noise that the decoded transfer still has

    // E‖t̂ − t‖² = ‖t̂ − y‖² + 2 tr cov(t̂, n) − ‖n‖², at least 0.
    double expected() const {
        const double energy = deviation + 2.0 * passed - noise;
        return energy < 0.0 ? 0.0 : energy;  // what is not a number stays that
    }
};

// Everything is relative to ‖y‖_w, the norm of the bake's transfer weighted by the light's spectrum.
struct TransferError {
    double deviation = 0.0;      // from the bake: ‖t̂ − y‖_w / ‖y‖_w
    double bake_noise = 0.0;     // of the bake from the truth: ‖d‖_w / ‖y‖_w
    double error = 0.0;          // expected, from the truth, in the bake's bands
    double missing_bands = 0.0;  // light of bands that the bake does not have, extrapolated
    // Largest deviation of a vertex and of a pose, relative to the RMS over vertices (poses) of
    // ‖y_v‖_w (‖y_p‖_w).
    double worst_vertex_deviation = 0.0;
    uint32_t worst_vertex = 0;
    double worst_pose_deviation = 0.0;
    uint32_t worst_pose = 0;
    std::vector<TransferBandEnergy> bands;  // [bands]

    double total() const { return std::hypot(error, missing_bands); }
};

// One animation against its bake, fed a plane at a time (transfer/layout.h).
class TransferErrorMeter {
  public:
    using Plane = Eigen::Ref<const Eigen::MatrixXf>;  // [V][P], a column a pose

    // layout  of the bake
    // kept    [P][K'] what the decoder can follow, from orthonormal_pose_space(): orthonormal, the
    //         constant first (checked)
    TransferErrorMeter(const TransferLayout& layout, uint32_t num_vertices, uint32_t num_poses,
                       BandPower spectrum, Eigen::MatrixXd kept);

    // Every plane of the bake once (checked). Planes in the same order give the same bits, on any
    // number of threads.
    // noise    BakedPose::noise: one draw with the variance of the bake's error, uncorrelated with it
    // decoded  zero where the bands are not kept
    void add(uint32_t plane, const Plane& baked, const Plane& noise, const Plane& decoded);

    // After all planes (checked).
    TransferError result() const;

    // How much of the noise is let through is measured apart for rows of which about as much is.
    static constexpr Eigen::Index kNumClasses = 25;

    // Memory of add() and of the sums over the rows of its blocks.
    // num_kept  K'
    static uint64_t scratch_bytes(uint64_t num_poses, uint64_t num_kept, uint64_t num_threads);

  private:
    // Sums over rows of products of scores along the kept directions and, last, of all that is left
    // of the rows beside these, [K' + 1][kNumClasses].
    struct ScaledFactors {
        Eigen::MatrixXd decoded_baked, baked, noise;
        void add(const ScaledFactors& other);
    };
    struct RowSums {
        TransferBandEnergy energy;
        ScaledFactors scores;
        Eigen::VectorXd pose_deviation;  // [P]
    };

    ScaledFactors zero_factors() const;
    RowSums measure_rows(Eigen::Index first, Eigen::Index count, double weight, const Plane& baked,
                         const Plane& noise, const Plane& decoded);

    TransferLayout layout_;
    Eigen::Index num_vertices_, num_poses_;
    BandPower spectrum_;
    Eigen::MatrixXd kept_;
    std::vector<bool> added_;  // [planes]
    std::vector<TransferBandEnergy> energy_;
    std::vector<ScaledFactors> factors_;    // [bands]
    std::vector<double> vertex_deviation_;  // [V] weighted
    Eigen::VectorXd pose_deviation_;        // [P] weighted
};

}  // namespace paim
