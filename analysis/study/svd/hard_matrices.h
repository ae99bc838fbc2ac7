// Data matrices that are hard to decompose: what the tests and paim-svd-study try the encoder on.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "paim/base/seed.h"

namespace paim {

struct HardMatrix {
    std::string name;
    Eigen::MatrixXf matrix;  // [rows][P]
    uint32_t rank;           // singular values that are more than rounding, centred
};

namespace hard {

using Eigen::Index;
using Eigen::MatrixXf;

// Uniform in [-1, 1), multiples of 2^-23, so that scaling by powers of two stays exact.
inline MatrixXf random(Index rows, Index poses, uint64_t seed = 1) {
    RandomStream stream(stream_key(seed, 0, 0));
    return MatrixXf::NullaryExpr(rows, poses, [&] {
        return static_cast<float>(std::floor(0x1p24 * stream.uniform())) * 0x1p-23f - 1.0f;
    });
}

// The power of two next to 10^-k.
inline float power_of_two_near(int k) {
    return std::ldexp(1.0f, -static_cast<int>(std::lround(k * std::log2(10.0))));
}

// Rows (k, i) are random numbers times ±1 by the k-th Walsh function of 16 poses, times about
// 10^-k, for k = 0 … 14. All exact in float; the means are zero, the Walsh functions are
// orthogonal: s_k is the length of the numbers times 4, in closed form.
inline MatrixXf graded_walsh(Index rows_of_each) {
    MatrixXf matrix(15 * rows_of_each, 16);
    const MatrixXf numbers = random(matrix.rows(), 1, 2);
    for (Index row = 0; row < matrix.rows(); ++row) {
        const auto k = static_cast<int>(row / rows_of_each);
        for (int p = 0; p < 16; ++p) {
            const bool odd = __builtin_parity(static_cast<unsigned>(p & (k + 1))) == 1;
            matrix(row, p) = (odd ? -1.0f : 1.0f) * numbers(row, 0) * power_of_two_near(k);
        }
    }
    return matrix;
}

// Random rows, the k-th of every `decades` of them scaled by about 10^-k.
inline MatrixXf graded_rows(Index rows, Index poses, int decades) {
    MatrixXf matrix = random(rows, poses, 3);
    for (Index row = 0; row < rows; ++row) {
        matrix.row(row) *= power_of_two_near(static_cast<int>(row) % decades);
    }
    return matrix;
}

// One row of each decade, so that each holds about one singular value.
inline MatrixXf graded_few_rows() {
    return graded_rows(15, 16, 15);
}

inline MatrixXf hilbert(Index rows, Index poses) {
    return MatrixXf::NullaryExpr(
        rows, poses, [](Index row, Index p) { return 1.0f / static_cast<float>(row + p + 1); });
}

// Whole numbers below 2^24: exactly of this rank, or one less once centred.
inline MatrixXf low_rank(Index rows, Index poses, Index rank) {
    const auto whole = [](float value) { return std::round(100.0f * value); };
    const MatrixXf shapes = random(rows, rank, 4).unaryExpr(whole);
    const MatrixXf weights = random(rank, poses, 5).unaryExpr(whole);
    return shapes * weights;
}

// Poses 0 … num_different − 1 again and again.
inline MatrixXf repeated_poses(Index rows, Index num_different, Index times) {
    return random(rows, num_different, 6).replicate(1, times);
}

}  // namespace hard

inline std::vector<HardMatrix> hard_matrices() {
    using namespace hard;
    constexpr float kTiniest = std::numeric_limits<float>::denorm_min();
    MatrixXf still(300, 7);
    still.colwise() = random(300, 1).col(0);
    MatrixXf far_away =
        0x1p-7f * random(500, 12).unaryExpr([](float v) { return std::round(64 * v); });
    far_away.array() += 65536.0f;  // moves by one to 64 of its roundings
    return {
        {"random", random(2000, 20), 19},
        {"graded, Walsh, 1 to 1e-14", graded_walsh(40), 15},
        {"graded rows, 1 to 1e-14", graded_few_rows(), 14},
        {"rows of scale 1 to 1e-14", graded_rows(300, 16, 15), 15},
        {"Hilbert 40 x 12", hilbert(40, 12), 11},
        {"Hilbert 12 x 12", hilbert(12, 12), 11},
        {"rank 1", low_rank(500, 20, 1), 1},
        {"rank 5", low_rank(20000, 40, 5), 5},
        {"still (rank 0)", still, 0},
        {"one pose", random(300, 1), 0},
        {"two poses", random(300, 2), 1},
        {"more poses than rows", random(6, 50), 6},
        {"one row", random(1, 20), 1},
        {"10 poses, each three times", repeated_poses(5000, 10, 3), 9},
        {"far from the origin", far_away, 11},
        {"times 1e30", 1e30f * random(400, 15), 14},
        {"times 1e-30", 1e-30f * random(400, 15), 14},
        {"rows of scale 1e30 to 1e16", 1e30f * graded_rows(300, 16, 15), 15},
        {"largest floats", std::numeric_limits<float>::max() * random(400, 15), 14},
        {"smallest floats",
         kTiniest * random(400, 15).unaryExpr([](float v) { return std::round(8 * v); }), 14},
    };
}

}  // namespace paim
