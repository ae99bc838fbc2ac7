// Transfer of partly shadowed vertices against its definition: the plain mean of visibility times
// basis over random directions, without any of the baker's devices.
#include <gtest/gtest.h>

#include <cmath>

#include "compressor/bake/ray_start.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/base/seed.h"
#include "paim/sh/basis_reference.h"
#include "paim/trace/ray_scene.h"
#include "poses/octopus.h"

namespace paim {
namespace {

constexpr int kBands = 5;
constexpr int kCoefficients = kBands * kBands;

// A direction of density cos θ / π round the normal: a random point of the unit sphere, added to
// it.
Vec3d cosine_direction(const Vec3d& normal, RandomStream& random) {
    const double z = 2.0 * random.uniform() - 1.0;
    const double angle = 2.0 * kPi * random.uniform();
    const double r = std::sqrt(1.0 - z * z);
    return (normal + Vec3d(r * std::cos(angle), r * std::sin(angle), z)).normalized();
}

TEST(TransferReference, EveryBandAgreesToTheNoiseOfTheReference) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const Pose pose = octopus.load_pose(0);
    // So many rays that its own noise is far below the reference's.
    const BakedPose baked = TransferBaker({kBands, 16384, 1}).bake(octopus.topology(), pose, 0);
    const RayScene scene(octopus.topology(), pose.positions);
    const RayStarts starts(octopus.topology(), pose.positions, pose.normals);
    ASSERT_EQ(starts.num_fans(), 0u);

    double chi_squared[kBands] = {};
    int num_values[kBands] = {};
    constexpr int kRays = 2000;
    int num_partly = 0;
    for (uint32_t v = 0; v < 1000; v += 25) {
        RandomStream random(stream_key(99, 0, v));
        double sum[kCoefficients] = {}, square[kCoefficients] = {};
        int num_open = 0;
        for (int j = 0; j < kRays; ++j) {
            const Vec3d w = cosine_direction(pose.normals[v].cast<double>(), random);
            if (scene.intersect_first(starts[v].origin, w.cast<float>())) continue;
            ++num_open;
            for (int l = 0; l < kBands; ++l) {
                for (int m = -l; m <= l; ++m) {
                    const double y = sh::basis_reference(l, m, w);
                    sum[sh::index(l, m)] += y;
                    square[sh::index(l, m)] += y * y;
                }
            }
        }
        if (num_open < kRays / 20 || num_open > kRays - kRays / 20) continue;
        ++num_partly;
        for (int i = 0; i < kCoefficients; ++i) {
            const double mean = sum[i] / kRays;
            const double variance = (square[i] / kRays - mean * mean) / kRays;
            const double difference = baked.transfer[static_cast<size_t>(i) * 1000 + v] - mean;
            chi_squared[sh::band_of(i)] += difference * difference / variance;
            ++num_values[sh::band_of(i)];
        }
    }
    EXPECT_GT(num_partly, 20);
    for (int l = 0; l < kBands; ++l) {
        // Squared standard scores have mean 1 and variance 2; four standard errors either way.
        // Within a vertex coefficients are correlated, which widens that by at most √(2l+1).
        const double expected_error = std::sqrt(2.0 * (2 * l + 1) / num_values[l]);
        EXPECT_NEAR(chi_squared[l] / num_values[l], 1.0, 4.0 * expected_error) << "band " << l;
        // And that bound is no empty one: a band off by a tenth of a percent of t_00 would not
        // pass.
        EXPECT_LT(4.0 * expected_error, 1.5) << "band " << l;
    }
}

}  // namespace
}  // namespace paim
