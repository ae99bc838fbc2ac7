// Outgoing radiance that is turned from frames, against matrices of rotation.
#include "paim/shade/turn_exit.h"

#include <gtest/gtest.h>

#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/sh/rotate.h"
#include "paim/transfer/layout.h"

namespace paim {
namespace {

Eigen::Matrix3f random_frame(RandomStream& random) {
    const auto number = [&] { return 2.0 * random.uniform() - 1.0; };
    const Eigen::Quaterniond rotation(number(), number(), number(), number());
    return rotation.normalized().toRotationMatrix().cast<float>();
}

struct Rows {
    std::vector<Eigen::Matrix3f> frames;
    std::vector<Vec3f> exit;
};

Rows random_rows(int out_bands, size_t num_rows) {
    RandomStream random(5);
    Rows rows;
    for (size_t r = 0; r < num_rows; ++r) rows.frames.push_back(random_frame(random));
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    for (size_t j = 0; j < static_cast<size_t>(sh::num_even_coefficients(out_bands)) * num_rows;
         ++j) {
        rows.exit.emplace_back(number(), number(), number());
    }
    return rows;
}

// Frames that are turned by nothing only put the even coefficients in their places.
TEST(TurnExit, OfTheIdentityIsTheSame) {
    const int bands = 4;
    Rows rows = random_rows(bands, 3);
    for (Eigen::Matrix3f& frame : rows.frames) frame.setIdentity();
    std::vector<Vec3f> turned(16 * 3);
    turn_exit(bands, rows.frames, rows.exit, turned);
    std::vector<Vec3f> expected(turned.size(), Vec3f::Zero());
    for (int k = 0; k < 10; ++k) {
        for (size_t r = 0; r < 3; ++r) {
            expected[static_cast<size_t>(sh::even_coefficient(k)) * 3 + r] =
                rows.exit[static_cast<size_t>(k) * 3 + r];
        }
    }
    for (size_t j = 0; j < turned.size(); ++j) EXPECT_LT((turned[j] - expected[j]).norm(), 5e-6f);
}

TEST(TurnExit, IsAMatrixOfRotation) {
    constexpr size_t kRows = 37;  // no multiple of a batch
    for (int bands = 1; bands <= static_cast<int>(kMaxOutBands); ++bands) {
        const Rows rows = random_rows(bands, kRows);
        std::vector<Vec3f> turned(static_cast<size_t>(bands * bands) * kRows);
        turn_exit(bands, rows.frames, rows.exit, turned);
        for (size_t r = 0; r < kRows; ++r) {
            const sh::Rotation rotation(bands, rows.frames[r].cast<double>());
            for (int l = 0; l < bands; ++l) {
                for (int i = 0; i < 2 * l + 1; ++i) {
                    Vec3d expected = Vec3d::Zero();
                    for (int k = sh::num_even_coefficients(l); k < sh::num_even_coefficients(l + 1);
                         ++k) {
                        expected += rotation.block(l)(i, sh::even_coefficient(k) - l * l) *
                                    rows.exit[static_cast<size_t>(k) * kRows + r].cast<double>();
                    }
                    const Vec3f got = turned[static_cast<size_t>(l * l + i) * kRows + r];
                    // The norm of a row is about that of num_even_coefficients random values.
                    const double norm = std::sqrt(sh::num_even_coefficients(bands));
                    EXPECT_LT((got.cast<double>() - expected).norm(), 2e-6 * norm)
                        << bands << " " << l << " " << i;
                }
            }
        }
    }
}

TEST(TurnExit, DoesNotDependOnTheNumberOfThreads) {
    const Rows rows = random_rows(4, 1000);
    std::vector<Vec3f> one(16 * 1000), many(16 * 1000);
    {
        const ThreadLimit limit(1);
        turn_exit(4, rows.frames, rows.exit, one);
    }
    turn_exit(4, rows.frames, rows.exit, many);
    EXPECT_EQ(one, many);
}

}  // namespace
}  // namespace paim
