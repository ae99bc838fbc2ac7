// Errors of a decoded transfer to the bake, and expected errors to the truth.
// Based on: Efron 2004 (noise_covariance.h)
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "paim/metrics/band_power.h"
#include "paim/metrics/noise_covariance.h"
#include "paim/transfer/layout.h"

namespace paim {

// The letters are those of docs/metrics.md: x is the baked transfer, x̂ the decoded, t the true
// one, and d the stored noise. Each is a vector of all values, over vertices, poses, channels and
// coefficients.

// Sums of squares over all values of a band, not weighted by the light. The covariance depends on the
// light, because vertices that share points are fitted by it.
struct TransferBandEnergy {
    double baked = 0.0;  // ‖x‖²
    double noise = 0.0;  // ‖d‖², an estimate of the squared error of the bake, ‖x − t‖²
    double error_to_bake = 0.0;     // ‖x̂ − x‖²
    double noise_covariance = 0.0;  // tr cov(x̂, x − t): noise of the bake that x̂ still has

    // E‖x̂ − t‖² = ‖x̂ − x‖² + 2 tr cov(x̂, x − t) − ‖x − t‖², at least 0; NaN stays NaN.
    double expected() const {
        const double energy = error_to_bake + 2.0 * noise_covariance - noise;
        return energy < 0.0 ? 0.0 : energy;
    }
};

// All errors are relative to ‖x‖_β, the norm of the bake's transfer weighted by the light's band
// power.
struct TransferError {
    double error_to_bake = 0.0;  // ‖x̂ − x‖_β / ‖x‖_β
    double bake_noise = 0.0;     // expected error of the bake to the truth: ‖d‖_β / ‖x‖_β
    double error = 0.0;          // expected error to the truth in the bake's bands
    double missing_bands = 0.0;  // light in bands that the bake does not have, extrapolated
    // Largest error to the bake of one vertex (pose), relative to the RMS of ‖x‖_β over vertices
    // (poses).
    double worst_vertex_error_to_bake = 0.0;
    uint32_t worst_vertex = 0;
    double worst_pose_error_to_bake = 0.0;
    uint32_t worst_pose = 0;
    std::vector<TransferBandEnergy> bands;  // [bands]

    double total() const { return std::hypot(error, missing_bands); }
};

// Measures one decoded animation against its bake, a plane (transfer/layout.h) at a time.
class TransferErrorMeter {
  public:
    using Plane = Eigen::Ref<const Eigen::MatrixXf>;  // [V][P], a column a pose

    // layout  of the bake
    // span    [P][K'] directions over the poses that the decoder can follow, from
    //         orthonormal_pose_space(): orthonormal, the constant first (checked)
    // points  of a decoder whose points are not the vertices
    TransferErrorMeter(const TransferLayout& layout, uint32_t num_vertices, uint32_t num_poses,
                       BandPower spectrum, const Eigen::MatrixXd& span,
                       std::optional<DecodedPoints> points = {});

    // Call it once (checked) for every plane that the file has, before the first add(). Planes in the same
    // order give the same bits on any number of threads, here and in add().
    // noise    BakedPose::noise: one draw with the variance of the bake's error, uncorrelated with
    //          it
    void survey(uint32_t plane, const Plane& baked, const Plane& noise);

    // Call it once for every plane of the bake (checked).
    // decoded  zero in planes that the file does not have
    void add(uint32_t plane, const Plane& baked, const Plane& noise, const Plane& decoded);

    // The errors; call it after all planes (checked).
    TransferError result() const;

    // Memory of what it holds, and of add().
    // num_points, num_points_each  as of NoiseCovariance::bytes()
    static uint64_t bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t span_size,
                          uint64_t num_points, uint64_t num_points_each);

  private:
    struct RowSums {
        TransferBandEnergy energy;           // but for the covariance
        Eigen::VectorXd pose_error_to_bake;  // [P] Σ (x̂ − x)², not weighted
    };

    void check_shapes(std::initializer_list<const Plane*> planes) const;
    RowSums measure_rows(Eigen::Index first, Eigen::Index count, double weight, const Plane& baked,
                         const Plane& noise, const Plane& decoded);

    TransferLayout layout_;
    Eigen::Index num_vertices_, num_poses_;
    BandPower spectrum_;
    NoiseCovariance covariance_;
    std::vector<bool> surveyed_, added_;        // [planes]
    std::vector<TransferBandEnergy> energy_;    // [bands]
    std::vector<double> vertex_error_to_bake_;  // [V] ‖x̂ − x‖²_β
    Eigen::VectorXd pose_error_to_bake_;        // [P] ‖x̂ − x‖²_β
};

}  // namespace paim
