// Rotation of coefficients: f'(ω) = f(R⁻¹ω).
// Based on: Ivanic and Ruedenberg, Rotation Matrices for Real Spherical Harmonics, J. Phys. Chem.
//           100, 1996, with the errata of 102, 1998 (and another correction of V for m < 0, see
//           rotate.cpp)
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace paim::sh {

// The block-diagonal matrix that turns coefficients, one (2l+1)×(2l+1) block a band, in double.
class Rotation {
  public:
    // bands     1 … kMaxBands
    // rotation  orthogonal with determinant 1 to 1e-6 (checked); the nearest true rotation is used
    // err       1e-12 an entry to 32 bands, 3e-11 at 64
    Rotation(int bands, const Eigen::Matrix3d& rotation);

    int bands() const { return static_cast<int>(blocks_.size()); }
    const Eigen::MatrixXd& block(int l) const { return blocks_[static_cast<size_t>(l)]; }

    // in, out  [bands²], may not overlap
    void apply(std::span<const double> in, std::span<double> out) const;
    void apply(std::span<const float> in, std::span<float> out) const;

  private:
    std::vector<Eigen::MatrixXd> blocks_;
};

}  // namespace paim::sh
