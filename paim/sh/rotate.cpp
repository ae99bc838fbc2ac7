// The matrix of band l is computed from that of band l−1 and the rotation. Names are those of the
// papers (R, P, u, v, w, U, V, W).
// Based on: Ivanic and Ruedenberg, Rotation Matrices for Real Spherical Harmonics, J. Phys. Chem.
//           100, 1996, and the errata of 102, 1998. Both misprint V for m < 0. The factors 1 − δ
//           and sqrt(1 + δ) with δ = δ_{m,−1} belong to the terms as written below; tests confirm
//           it.
#include "paim/sh/rotate.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdlib>

#include "paim/base/check.h"
#include "paim/sh/index.h"

namespace paim::sh {

namespace {

// A block whose rows and columns have the indices −l … l, as in the papers.
class Block {
  public:
    explicit Block(const Eigen::MatrixXd& matrix)
        : matrix_(matrix), l_(static_cast<int>(matrix.rows() - 1) / 2) {}
    double operator()(int m, int n) const { return matrix_(m + l_, n + l_); }

  private:
    const Eigen::MatrixXd& matrix_;
    int l_;
};

double P(int i, int l, int a, int b, const Block& R, const Block& previous) {
    if (b == l) return R(i, 1) * previous(a, l - 1) - R(i, -1) * previous(a, -l + 1);
    if (b == -l) return R(i, 1) * previous(a, -l + 1) + R(i, -1) * previous(a, l - 1);
    return R(i, 0) * previous(a, b);
}

double V(int l, int m, int n, const Block& R, const Block& previous) {
    if (m == 0) return P(1, l, 1, n, R, previous) + P(-1, l, -1, n, R, previous);
    if (m == 1) return std::sqrt(2.0) * P(1, l, 0, n, R, previous);
    if (m == -1) return std::sqrt(2.0) * P(-1, l, 0, n, R, previous);
    if (m > 0) return P(1, l, m - 1, n, R, previous) - P(-1, l, -m + 1, n, R, previous);
    return P(1, l, m + 1, n, R, previous) + P(-1, l, -m - 1, n, R, previous);
}

double W(int l, int m, int n, const Block& R, const Block& previous) {
    if (m > 0) return P(1, l, m + 1, n, R, previous) + P(-1, l, -m - 1, n, R, previous);
    return P(1, l, m - 1, n, R, previous) - P(-1, l, -m + 1, n, R, previous);
}

Eigen::MatrixXd next_block(int l, const Block& R, const Block& previous) {
    Eigen::MatrixXd block(2 * l + 1, 2 * l + 1);
    for (int m = -l; m <= l; ++m) {
        const int k = std::abs(m);
        for (int n = -l; n <= l; ++n) {
            const double denominator =
                std::abs(n) == l ? 2.0 * l * (2.0 * l - 1.0) : (l + n) * static_cast<double>(l - n);
            const double u = std::sqrt((l + m) * static_cast<double>(l - m) / denominator);
            const double v = (m == 0 ? -std::sqrt(0.5) : 0.5) *
                             std::sqrt((l + k - 1) * static_cast<double>(l + k) / denominator);
            const double w =
                m == 0 ? 0.0
                       : -0.5 * std::sqrt((l - k - 1) * static_cast<double>(l - k) / denominator);
            // Entries that do not exist in band l−1 have the factor 0.
            double sum = v * V(l, m, n, R, previous);
            if (u != 0.0) sum += u * P(0, l, m, n, R, previous);
            if (w != 0.0) sum += w * W(l, m, n, R, previous);
            block(m + l, n + l) = sum;
        }
    }
    return block;
}

template <typename T>
void apply_blocks(const std::vector<Eigen::MatrixXd>& blocks, std::span<const T> in,
                  std::span<T> out) {
    const int bands = static_cast<int>(blocks.size());
    PAIM_CHECK_EQ(in.size(), static_cast<size_t>(num_coefficients(bands)));
    PAIM_CHECK_EQ(out.size(), in.size());
    PAIM_CHECK(in.data() + in.size() <= out.data() || out.data() + out.size() <= in.data());
    for (int l = 0; l < bands; ++l) {
        const Eigen::Index size = 2 * l + 1;
        using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
        const Eigen::Map<const Vector> from(in.data() + index(l, -l), size);
        Eigen::Map<Vector> to(out.data() + index(l, -l), size);
        to = (blocks[static_cast<size_t>(l)] * from.template cast<double>()).template cast<T>();
    }
}

}  // namespace

Rotation::Rotation(int bands, const Eigen::Matrix3d& rotation) {
    PAIM_CHECK_LE(1, bands);
    PAIM_CHECK_LE(bands, kMaxBands);
    const Eigen::Matrix3d gram = rotation.transpose() * rotation;
    PAIM_CHECK_LE((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-6);
    PAIM_CHECK_LE(std::abs(rotation.determinant() - 1.0), 1e-6);
    // An error of 1e-6 in the rotation would be l times as large in band l.
    const Eigen::Matrix3d exact = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();

    blocks_.reserve(static_cast<size_t>(bands));
    blocks_.push_back(Eigen::MatrixXd::Identity(1, 1));
    if (bands == 1) return;
    // Orders −1, 0, 1 are y, z, x.
    const int axis[3] = {1, 2, 0};
    Eigen::MatrixXd first(3, 3);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) first(i, j) = exact(axis[i], axis[j]);
    }
    blocks_.push_back(first);
    for (int l = 2; l < bands; ++l) {
        blocks_.push_back(next_block(l, Block(blocks_[1]), Block(blocks_.back())));
    }
}

void Rotation::apply(std::span<const double> in, std::span<double> out) const {
    apply_blocks(blocks_, in, out);
}

void Rotation::apply(std::span<const float> in, std::span<float> out) const {
    apply_blocks(blocks_, in, out);
}

}  // namespace paim::sh
