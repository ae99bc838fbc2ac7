// The road from a bake through the encoder, the file and the decoder, against the bake itself.
#include "compressor/encode/encode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compressor/bake/bake_sequence.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/asset_error.h"
#include "paim/metrics/singular_value_error.h"
#include "poses/octopus.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kNumPoses = 6;
constexpr ComponentChoice kAll{ComponentChoice::Kind::all, 0};

constexpr ComponentChoice first(uint32_t number) {
    return {ComponentChoice::Kind::number, number};
}

// The baked octopus: rank 5 in both parts, six noisy poses less their mean.
class Encode : public testing::Test {
  protected:
    Encode() {
        const PoseSet octopus = poses::make_octopus(1000, kNumPoses);
        bake_sequence(octopus, {4, 32, 1}, "faces", directory_ / "x.bake", 0, kNumPoses - 1,
                      [](uint32_t) {});
    }

    Asset encode_with(const ComponentChoice& geometry, const ComponentChoice& transfer) const {
        EncodeOptions options;
        options.geometry = geometry;
        options.transfer = transfer;
        options.noise = NoiseTreatment::keep;
        encode(BakeReader(directory_ / "x.bake"), options, directory_ / "x.paim");
        return read_paim(directory_ / "x.paim");
    }

    TemporaryDirectory directory_;
};

// |mean| + Σ_k |component · weight| of row r, pose p: what roundings are relative to.
double magnitude(const LowRank& matrix, size_t r, uint32_t p) {
    double sum = std::abs(matrix.mean[r]);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        sum += std::abs(static_cast<double>(matrix.components[k][r]) *
                        matrix.weights[size_t{k} * matrix.num_poses + p]);
    }
    return sum;
}

void expect_back_to_rounding(const LowRank& matrix, uint32_t p, const std::vector<float>& decoded,
                             const std::vector<float>& baked) {
    ASSERT_EQ(decoded.size(), baked.size());
    // Floats round by at most u = 2^-24 of the value. The mean is stored with one rounding, each
    // term component · weight with three (both factors, the product), and each of the K additions
    // rounds a partial sum no larger than the magnitude: K + 4 roundings of it at most. The
    // decomposition in double adds parts in 10^13 of numbers below 10.
    const double num_roundings = matrix.num_components + 4.0;
    for (size_t r = 0; r < baked.size(); ++r) {
        ASSERT_NEAR(decoded[r], baked[r], num_roundings * 0x1p-24 * magnitude(matrix, r, p) + 1e-12)
            << "row " << r << ", pose " << p;
    }
}

TEST_F(Encode, AllComponentsGiveTheBakeBack) {
    const Asset asset = encode_with(kAll, kAll);
    EXPECT_EQ(asset.moving().positions.num_components, kNumPoses - 1);
    EXPECT_EQ(asset.moving().transfer->matrix.num_components, kNumPoses - 1);
    const BakeReader bake(directory_ / "x.bake");
    EXPECT_EQ(asset.moving().topology, bake.topology());
    EXPECT_EQ(asset.moving().albedo.values, bake.albedo().values);
    const LowRank& transfer = asset.moving().transfer->matrix;
    MeshDecoder decoder(asset.moving());
    DecodedPose pose;
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        decoder.decode(p, {}, pose);
        const BakedPose baked = bake.read_pose(p);
        expect_back_to_rounding(asset.moving().positions, p, pose.positions, baked.positions);
        expect_back_to_rounding(transfer, p, pose.transfer, baked.transfer);
    }
}

// √(Σ (decoded − baked)² / Σ (baked − mean over poses)²), in double.
double relative_error(const std::vector<std::vector<float>>& decoded,
                      const std::vector<std::vector<float>>& baked) {
    double error = 0.0, total = 0.0;
    for (size_t r = 0; r < baked[0].size(); ++r) {
        double mean = 0.0;
        for (const auto& pose : baked) mean += pose[r] / static_cast<double>(baked.size());
        for (size_t p = 0; p < baked.size(); ++p) {
            const double lost = static_cast<double>(decoded[p][r]) - baked[p][r];
            const double moved = baked[p][r] - mean;
            error += lost * lost;
            total += moved * moved;
        }
    }
    return std::sqrt(error / total);
}

// The Frobenius norm of what is dropped is that of its singular values (Eckart and Young, 1936), so
// the energy error that the file states is the error of the decoded animation. Floats spoil that
// little: with errors of 0.1 and more of the movement, roundings of 10^-7 of the positions (which
// are a few times the movement) are at most 10^-5 of the error. They are random, so they add to it
// in squares, 10^-10, but for a chance correlation of
// 10^-5 / √(rows · poses) = 10^-5 / √18000 < 10^-7. Both are below the 10^-6 that is asked for.
TEST_F(Encode, TruncationErrorIsWhatTheDroppedSingularValuesSay) {
    const BakeReader bake(directory_ / "x.bake");
    std::vector<std::vector<float>> positions, transfer;
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        BakedPose pose = bake.read_pose(p);
        positions.push_back(std::move(pose.positions));
        transfer.push_back(std::move(pose.transfer));
    }
    const auto check = [&](const Asset& asset, const DecodeLimits& limits) {
        MeshDecoder decoder(asset.moving());
        std::vector<std::vector<float>> decoded_positions, decoded_transfer;
        DecodedPose pose;
        for (uint32_t p = 0; p < kNumPoses; ++p) {
            decoder.decode(p, limits, pose);
            decoded_positions.push_back(pose.positions);
            decoded_transfer.push_back(pose.transfer);
        }
        const auto kept = [](const LowRank& matrix, uint32_t limit) {
            return energy_error(matrix.singular_values, std::min(matrix.num_components, limit));
        };
        const double geometry = kept(asset.moving().positions, limits.geometry_components);
        const double light = kept(asset.moving().transfer->matrix, limits.transfer_components);
        ASSERT_GT(geometry, 0.05);
        ASSERT_GT(light, 0.05);
        EXPECT_NEAR(relative_error(decoded_positions, positions) / geometry, 1.0, 1e-6);
        EXPECT_NEAR(relative_error(decoded_transfer, transfer) / light, 1.0, 1e-6);
    };
    for (uint32_t k = 0; k < 4; ++k) {
        check(encode_with(first(k), first(3 - k)), {});
    }
    // Dropped when it is decoded instead of when it is encoded: the same.
    const Asset all = encode_with(kAll, kAll);
    DecodeLimits limits;
    limits.geometry_components = 2;
    limits.transfer_components = 1;
    check(all, limits);
}

TEST_F(Encode, FewerComponentsAreAPrefixOfAll) {
    const CodedMesh all = encode_with(kAll, kAll).moving();
    const CodedMesh some = encode_with(first(2), first(3)).moving();
    EXPECT_EQ(some.positions.singular_values, all.positions.singular_values);
    EXPECT_EQ(some.positions.mean, all.positions.mean);
    EXPECT_TRUE(std::equal(some.positions.components.begin(), some.positions.components.end(),
                           all.positions.components.begin()));
    const LowRank &fewer = some.transfer->matrix, &more = all.transfer->matrix;
    EXPECT_TRUE(std::equal(fewer.weights.begin(), fewer.weights.end(), more.weights.begin()));
}

TEST_F(Encode, StillAnimationsNeedNoComponents) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    bake_sequence(octopus, {2, 32, 1}, "faces", directory_ / "still.bake", 0, 0, [](uint32_t) {});
    const BakeReader bake(directory_ / "still.bake");
    for (const auto kind : {ComponentChoice::Kind::all, ComponentChoice::Kind::automatic}) {
        EncodeOptions options;
        options.geometry = options.transfer = {kind, 0};
        const EncodeSummary summary = encode(bake, options, directory_ / "still.paim");
        EXPECT_EQ(summary.geometry_components + summary.transfer_components, 0u);
        EXPECT_EQ(summary.transfer_energy_error, 0.0);
        const Asset asset = read_paim(directory_ / "still.paim");
        EXPECT_EQ(asset.moving().positions.mean.floats(), bake.read_pose(0).positions);
        EXPECT_EQ(asset.moving().transfer->matrix.mean.floats(), bake.read_pose(0).transfer);
    }
}

TEST_F(Encode, PosesThatAreAllTheSameNeedNoneAndLoseNothing) {
    // Five times what pose 0 baked to: tracing again would differ by its noise.
    const BakeReader moving(directory_ / "x.bake");
    const BakedPose pose = moving.read_pose(0);
    BakeIdentity identity = moving.identity();
    identity.poses.resize(5);
    const BakeWriter writer(directory_ / "same.bake", identity, moving.topology(), moving.albedo());
    for (uint32_t p = 0; p < 5; ++p) writer.write_pose(p, pose);
    for (const auto kind : {ComponentChoice::Kind::all, ComponentChoice::Kind::automatic}) {
        EncodeOptions options;
        options.geometry = options.transfer = {kind, 0};
        const EncodeSummary summary =
            encode(BakeReader(directory_ / "same.bake"), options, directory_ / "same.paim");
        EXPECT_EQ(summary.geometry_rank + summary.transfer_rank, 0u);
        // Not NaN, although nothing is divided by nothing.
        for (const double error : {summary.geometry_theory_error, summary.transfer_theory_error,
                                   summary.geometry_energy_error, summary.transfer_energy_error}) {
            EXPECT_EQ(error, 0.0);
        }
        const Asset asset = read_paim(directory_ / "same.paim");
        EXPECT_EQ(asset.moving().positions.mean.floats(), pose.positions);
        EXPECT_EQ(asset.moving().transfer->matrix.mean.floats(), pose.transfer);
        EXPECT_EQ(theory_error(asset.moving().transfer->matrix.singular_values, 0), 0.0);
        EXPECT_EQ(energy_error(asset.moving().positions.singular_values, 0), 0.0);
    }
}

// A caller who asks for it gets a file that states its errors, from encode() alone.
TEST_F(Encode, MeasuresAndStatesTheErrorsIfAsked) {
    EncodeOptions options;
    options.transfer = first(2);
    const BakeReader bake(directory_ / "x.bake");
    EXPECT_FALSE(encode(bake, options, directory_ / "x.paim").measured);
    options.measure = true;
    const EncodeSummary summary = encode(bake, options, directory_ / "x.paim");
    ASSERT_TRUE(summary.measured);
    EXPECT_EQ(summary.size_bytes, std::filesystem::file_size(directory_ / "x.paim"));
    const Asset asset = read_paim(directory_ / "x.paim");
    const ErrorStatement stated = read_error_statement(asset, directory_ / "x.paim");
    EXPECT_EQ(stated.band_power, "flat");
    // The same file measured again: the same operations in the same order, so the same bits.
    const AssetError again = measure_asset(asset, bake, BandPower::flat(4));
    const std::vector<NamedError> expected = named_errors(again);
    const std::vector<NamedError> returned = named_errors(*summary.measured);
    ASSERT_EQ(stated.errors.size(), expected.size());
    ASSERT_EQ(returned.size(), expected.size());
    for (size_t j = 0; j < expected.size(); ++j) {
        EXPECT_EQ(stated.errors[j].name, expected[j].name);
        EXPECT_EQ(stated.errors[j].value, expected[j].value) << expected[j].name;
        EXPECT_EQ(returned[j].value, expected[j].value) << expected[j].name;
    }
    EXPECT_GT(again.transfer.error_to_bake, 0.0);  // components were dropped
}

}  // namespace
}  // namespace paim
