// Theory of curves over components of a vertex and rays, against what is decoded and against numbers by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "analysis/setting_curves/group_curve.h"
#include "analysis/setting_curves/ray_curve.h"
#include "analysis/setting_curves/vertex_component_theory.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/codec/codecs.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/point_groups.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/singular_value_error.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

TEST(RayLaw, NoiseFallsAsThePowerOfTheSampler) {
    // Random directions: four times the rays, half the noise.
    EXPECT_NEAR(expected_noise(0.04, 64, 256, SamplerKind::uniform), 0.02, 1e-15);
    EXPECT_NEAR(expected_noise(0.04, 256, 64, SamplerKind::uniform), 0.08, 1e-15);
    // A lattice: 16 times the rays, an eighth of the noise.
    EXPECT_NEAR(expected_noise(0.08, 64, 1024, SamplerKind::cosine), 0.01, 1e-15);
    EXPECT_EQ(expected_noise(0.08, 64, 64, SamplerKind::cosine), 0.08);
}

TEST(SettingValues, AreTheMostAndSmallerOnes) {
    EXPECT_EQ(values_up_to(8, {4, 9, 4, 0, 8}), (std::vector<uint32_t>{8, 4, 0}));
    EXPECT_EQ(values_up_to(8, {}), (std::vector<uint32_t>{8}));
}

class GroupedFileTest : public testing::Test {
  protected:
    // In so many groups.
    Asset make(uint32_t num_groups) {
        EncodeOptions options;
        options.precision = Precision::i16;
        EncodeTarget target;
        target.geometry_error = 1e-3;
        target.spectrum = BandPower::flat(4);
        if (!series_) series_.emplace(bake_, options, target.spectrum);
        series_->encode_groups(target, grouped_encoder(), num_groups, directory_ / "x.paim");
        return read_paim(directory_ / "x.paim");
    }

    // Norm of the difference of two numbers of components of a vertex, over all vertices and poses.
    static double difference(const Asset& asset, uint32_t a, uint32_t b) {
        MeshDecoder decoder(asset.moving());
        DecodedPose one, other;
        double sum = 0.0;
        for (uint32_t p = 0; p < asset.num_poses(); ++p) {
            DecodeLimits limits;
            limits.vertex_components = a;
            decoder.decode(p, limits, one);
            limits.vertex_components = b;
            decoder.decode(p, limits, other);
            for (size_t j = 0; j < one.transfer.size(); ++j) {
                sum += std::pow(static_cast<double>(one.transfer[j]) - other.transfer[j], 2.0);
            }
        }
        return std::sqrt(sum);
    }

    const TemporaryDirectory directory_;
    const BakeReader bake_ = write_target_bake(directory_ / "sheet.bake", {.noise = 0.05});
    std::optional<TargetSeries> series_;
};

// Components of a group are orthogonal, but for the rounding to integers.
TEST_F(GroupedFileTest, TheEnergyErrorIsWhatDroppingComponentsOfAVertexLoses) {
    const Asset asset = make(6);
    const TransferModel& transfer = *asset.moving().transfer;
    const uint32_t all = transfer.num_vertex_components();
    ASSERT_EQ(all, 8u);
    const VertexComponentSpectrum spectrum = vertex_component_spectrum(transfer);
    ASSERT_EQ(spectrum.sum.size(), all);
    const double whole = difference(asset, all, 0);
    for (uint32_t kept = 1; kept < all; ++kept) {
        const double expected = difference(asset, all, kept) / whole;
        EXPECT_NEAR(energy_error(spectrum.root, kept) / expected, 1.0, 0.02) << kept;
        EXPECT_GT(spectrum.sum[kept - 1], spectrum.sum[kept]);
        // Six groups: a sum of norms is at most √6 of the root of their squares.
        EXPECT_GE(spectrum.sum[kept], spectrum.root[kept]);
        EXPECT_LE(spectrum.sum[kept], std::sqrt(6.0) * spectrum.root[kept] * (1 + 1e-12));
    }
}

TEST_F(GroupedFileTest, OfVerticesWithoutComponentsThereIsNoTheory) {
    EXPECT_TRUE(vertex_component_spectrum(*plain_transfer(LowRank())).sum.empty());
}

TEST_F(GroupedFileTest, MoreGroupsErrLessUntilThereAreNoMoreVertices) {
    double before = 1.0;
    for (const uint32_t num_groups : {1u, 5u, 20u, 50u, 1000u}) {
        const Asset asset = make(num_groups);
        EXPECT_EQ(asset.moving().transfer->point_groups()->num_groups, std::min(num_groups, 50u));
        const AssetError error = measure_asset(asset, bake_, BandPower::flat(4));
        if (num_groups == 1000) {
            EXPECT_EQ(error.transfer.error_to_bake, before);  // 400 vertices, at least 8 a group
        } else {
            EXPECT_LT(error.transfer.error_to_bake, before);
        }
        EXPECT_LE(error.geometry.relative_rms(), 1e-3);
        before = error.transfer.error_to_bake;
    }
}

}  // namespace
}  // namespace paim
