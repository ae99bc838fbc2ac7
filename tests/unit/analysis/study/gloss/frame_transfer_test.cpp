#include "analysis/study/gloss/frame_transfer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compressor/bake/transfer_baker.h"
#include "compressor/material/brdfs.h"
#include "compressor/material/open_gloss.h"
#include "paim/base/seed.h"
#include "paim/mesh/tangent_frames.h"
#include "paim/sh/basis.h"
#include "poses/octopus.h"
#include "tests/unit/material/lambertian.h"

namespace paim::study {
namespace {

using Eigen::Index;

struct Octopus {
    PoseSet set = poses::make_octopus(1000, 1);
    Pose pose = set.load_pose(0);
    std::vector<Eigen::Matrix3f> frames =
        TangentFrames(set.topology(), pose.positions).at(pose.positions, pose.normals);
};

// A Lambertian surface sends out its diffuse transfer in every direction.
TEST(FrameTransfer, OfALambertianSurfaceIsTheDiffuseTransfer) {
    const Octopus octopus;
    const ExitFunctions exit(Lambertian(1.0), 1);
    FrameTransferOptions options;
    options.rays = 4096;
    const Eigen::MatrixXf glossy =
        frame_transfer(octopus.set.topology(), octopus.pose, octopus.frames, exit, options);
    BakeOptions bake;
    bake.rays = 4096;
    bake.seed = 5;
    const BakedPose diffuse = TransferBaker(bake).bake(octopus.set.topology(), octopus.pose, 0);
    const Eigen::Map<const Eigen::MatrixXf> expected(diffuse.transfer.data(), glossy.rows(),
                                                     glossy.cols());
    const Eigen::MatrixXf sent = static_cast<float>(std::sqrt(1.0 / (4.0 * kPi))) * glossy;
    // Noise of 2,048 rays is 0.45 % (docs/results/noise.md), of 4,096 less; the difference of two
    // bakes has √2 of it.
    EXPECT_LT((sent - expected).norm() / expected.norm(), 0.0065f);
    EXPECT_GT((sent - expected).norm() / expected.norm(), 0.0f);
}

// Both are the same function of the direction.
TEST(FrameTransfer, TurnsIntoTheAxesOfThePose) {
    const Octopus octopus;
    const ExitFunctions exit(*parse_brdf("phong:0.5,10"), 4);
    FrameTransferOptions options;
    options.in_bands = 3;
    options.rays = 64;
    const Eigen::MatrixXf local =
        frame_transfer(octopus.set.topology(), octopus.pose, octopus.frames, exit, options);
    const Eigen::MatrixXf turned = in_pose_axes(local, octopus.frames, exit);
    ASSERT_EQ(local.cols(), 10 * 9);
    ASSERT_EQ(turned.cols(), 16 * 9);
    RandomStream random(1);
    for (Index v = 0; v < local.rows(); v += 7) {
        const Vec3d direction =
            Vec3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
                .normalized();
        const Vec3d in_frame =
            octopus.frames[static_cast<size_t>(v)].cast<double>().transpose() * direction;
        double basis[16], local_basis[16];
        sh::evaluate_basis(4, direction, std::span(basis));
        sh::evaluate_basis(4, in_frame, std::span(local_basis));
        for (Index i = 0; i < 9; ++i) {
            double by_frame = 0.0, by_pose = 0.0;
            for (Index k = 0; k < 10; ++k) {
                by_frame += local_basis[exit.coefficients()[static_cast<size_t>(k)]] *
                            static_cast<double>(local(v, k * 9 + i));
            }
            for (Index o = 0; o < 16; ++o) {
                by_pose += basis[o] * static_cast<double>(turned(v, o * 9 + i));
            }
            // Sums of sixteen products of floats of about 1.
            EXPECT_NEAR(by_frame, by_pose, 3e-6);
        }
    }
}

// Without anything in its way it is an integral over the hemisphere, known by quadrature.
TEST(FrameTransfer, OfAnOpenVertexIsItsQuadrature) {
    const Topology topology{3, {{0, 1, 2}}};
    const Pose pose{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
    const ExitFunctions exit(*parse_brdf("cook-torrance:0.5,0.4"), 6);
    FrameTransferOptions options;
    options.in_bands = 5;
    options.rays = 1 << 16;
    const std::vector<Eigen::Matrix3f> frames(3, Eigen::Matrix3f::Identity());
    const Eigen::MatrixXf transfer = frame_transfer(topology, pose, frames, exit, options);
    const std::vector<double> open = open_gloss(exit, 5);
    ASSERT_EQ(static_cast<size_t>(transfer.cols()), open.size());
    // The lattice has 256
    // points along a side, which counts the jump at the horizon to 1 / 256 of a ring, and smooth
    // values far better: 1e-3 of the largest value.
    const double largest = *std::max_element(open.begin(), open.end());
    for (size_t c = 0; c < open.size(); ++c) {
        EXPECT_NEAR(static_cast<double>(transfer(0, static_cast<Index>(c))), open[c],
                    1e-3 * largest);
    }
}

}  // namespace
}  // namespace paim::study
