// A codec is one folder: one that nobody outside this folder knows is written, read, played, cut
// short and measured like those that come with the library.
#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/codec/component_planes.h"
#include "paim/codec/cut.h"
#include "paim/codec/playback.h"
#include "paim/codec/svd/svd_transfer.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/prefix_error.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"
#include "tests/toy_codec/shared_points.h"

namespace paim {
namespace {

using toy::SharedPoints;

class ToyCodec : public testing::Test {
  protected:
    static void SetUpTestSuite() { add_transfer_codec(toy::codec()); }

    // The example's four vertices on the first two of its points.
    ToyCodec() : asset_(make_example_asset(3, 3)), by_vertex_(asset_) {
        const LowRank points = first_points(asset_.moving().transfer->matrix, 2);
        asset_.moving().transfer = SharedPoints(points, kOwner, kGain);
        by_vertex_.moving().transfer = SvdTransfer(expanded(points));
    }

    static LowRank first_points(LowRank matrix, uint32_t count) {
        const auto cut = [&](StoredValues& values) {
            std::vector<float> kept;
            for (uint32_t plane = 0; plane < matrix.num_planes; ++plane) {
                for (uint32_t n = 0; n < count; ++n) {
                    kept.push_back(values[size_t{plane} * matrix.num_points + n]);
                }
            }
            values = std::move(kept);
        };
        cut(matrix.mean);
        for (StoredValues& component : matrix.components) cut(component);
        matrix.num_points = count;
        return matrix;
    }

    // The same transfer with values of its own for every vertex.
    static LowRank expanded(LowRank matrix) {
        const uint32_t num_points = matrix.num_points;
        const auto expand = [&](StoredValues& values) {
            std::vector<float> all;
            for (uint32_t plane = 0; plane < matrix.num_planes; ++plane) {
                for (size_t v = 0; v < kOwner.size(); ++v) {
                    all.push_back(kGain[v] * values[size_t{plane} * num_points + kOwner[v]]);
                }
            }
            values = std::move(all);
        };
        expand(matrix.mean);
        for (StoredValues& component : matrix.components) expand(component);
        matrix.num_points = static_cast<uint32_t>(kOwner.size());
        return matrix;
    }

    static std::vector<Vec3f> radiance(const Asset& asset) {
        Playback playback(std::make_shared<const Asset>(asset));
        std::vector<Vec3f> light(9, Vec3f(0.5f, 1.0f, -0.25f));
        playback.set_light(DistantLight({3, light}));
        playback.update(1.5);
        const auto shown = playback.radiance();
        return {shown.begin(), shown.end()};
    }

    inline static const std::vector<uint32_t> kOwner{1, 0, 0, 1};
    inline static const std::vector<float> kGain{1.0f, 0.5f, -2.0f, 4.0f};  // exact products

    const TemporaryDirectory directory_;
    Asset asset_;
    Asset by_vertex_;
};

// Gains are powers of two, so that both orders of operations round alike.
TEST_F(ToyCodec, IsPlayed) {
    EXPECT_EQ(radiance(asset_), radiance(by_vertex_));
    EXPECT_EQ(decode_plane(asset_.moving(), Attribute::transfer, 4),
              decode_plane(by_vertex_.moving(), Attribute::transfer, 4));
}

TEST_F(ToyCodec, ComesBackFromAFile) {
    write_paim(directory_ / "x.paim", asset_);
    const Asset read = read_paim(directory_ / "x.paim");
    const auto* const transfer = read.moving().transfer.as<SharedPoints>();
    ASSERT_NE(transfer, nullptr);
    EXPECT_EQ(transfer->owner, kOwner);
    EXPECT_EQ(transfer->gain, kGain);
    EXPECT_EQ(transfer->matrix.components, asset_.moving().transfer->matrix.components);
    EXPECT_EQ(radiance(read), radiance(asset_));
}

TEST_F(ToyCodec, IsCutShort) {
    Asset few = asset_, few_by_vertex = by_vertex_;
    DecodeLimits limits;
    limits.bands = 2;
    limits.transfer_components = 1;
    keep_within(limits, few);
    keep_within(limits, few_by_vertex);
    EXPECT_EQ(radiance(few), radiance(few_by_vertex));
}

TEST_F(ToyCodec, IsMeasured) {
    const std::vector<double> alike(asset_.moving().layout.num_planes(), 1.0);
    const ComponentEnergy toy = component_energy(asset_.moving(), Attribute::transfer, alike);
    const ComponentEnergy svd = component_energy(by_vertex_.moving(), Attribute::transfer, alike);
    for (size_t k = 0; k < svd.dropped.size(); ++k) {
        EXPECT_NEAR(toy.dropped[k], svd.dropped[k], 1e-12 * svd.decoded);  // sums in another order
    }
}

TEST_F(ToyCodec, RefusesAnOwnerThatIsNoPoint) {
    asset_.moving().transfer.as<SharedPoints>()->owner[2] = 2;
    write_paim(directory_ / "x.paim", asset_);
    try {
        read_paim(directory_ / "x.paim");
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find("TOWN"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace paim
