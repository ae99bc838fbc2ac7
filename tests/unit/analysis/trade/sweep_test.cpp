// Sweeps over a small bake: points are the files that encode_to_target() makes.
#include "analysis/trade/sweep.h"

#include <gtest/gtest.h>

#include "analysis/trade/table.h"
#include "analysis/trade/trade.h"
#include "compressor/encode/encode.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/tbb_parallel.h"
#include "paim/codec/codecs.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

class SweepTest : public testing::Test {
  protected:
    const TemporaryDirectory directory_;
    const BakeReader bake_ = write_target_bake(directory_ / "sheet.bake", {.noise = 0.01});
    const std::filesystem::path scratch_ = directory_ / "scratch.paim";
};

// Integers alone.
SweepAxes integers(std::vector<std::string> errors) {
    return {std::move(errors), {}, {Precision::i16}};
}

// With the defaults of the command line, by hand.
TargetSummary encode_alone(const BakeReader& bake, const TradeSettings& settings,
                           const std::filesystem::path& output) {
    EncodeOptions options;
    options.precision = Precision::i16;
    options.bands = settings.bands;
    options.name = output.stem().string();
    EncodeTarget target;
    target.transfer_error = settings.transfer_error();
    if (!settings.geometry_error.empty()) target.geometry_error = settings.geometry_target();
    target.codec = settings.codec;
    target.preference = settings.preference;
    target.spectrum = BandPower::flat(4);
    return encode_to_target(bake, options, target, output);
}

TEST_F(SweepTest, PointsAreTheFilesOfSingleEncodes) {
    std::vector<std::vector<char>> swept;
    const PlayFile keep = [&](const Asset& asset) {
        EXPECT_EQ(asset.name, "sheet");
        swept.push_back(read_file(scratch_, uint64_t{1} << 30));
        return PlayedFile{0.25, 1.0};
    };
    Sweep sweep(bake_, "sheet", scratch_, keep);
    std::vector<TradePoint> points;
    uint64_t num_done = 0;
    sweep.measure_all(4, integers({"20%", "5%"}), points, [&](uint64_t n) { num_done += n; });
    ASSERT_EQ(points.size(), 16u);
    ASSERT_EQ(swept.size(), 16u);
    EXPECT_EQ(num_done, 16u);
    EXPECT_TRUE(sweep.notes().empty());
    EXPECT_FALSE(std::filesystem::exists(scratch_));
    const std::filesystem::path output = directory_ / "sheet.paim";
    for (size_t n = 0; n < points.size(); ++n) {
        const TradePoint& point = points[n];
        const TargetSummary summary = encode_alone(bake_, point.settings, output);
        EXPECT_TRUE(swept[n] == read_file(output, uint64_t{1} << 30)) << n;
        EXPECT_EQ(point.size_bytes, swept[n].size());
        EXPECT_EQ(point.transfer_error(), summary.error.transfer.total());
        EXPECT_EQ(point.error.geometry.rms(), summary.error.geometry.rms());
        EXPECT_EQ(point.transfer_components, summary.chosen().components);
        EXPECT_EQ(point.multiply_adds, summary.chosen().multiply_adds);
        EXPECT_EQ(point.position_multiply_adds, 3 * (point.geometry_components + 1));
        // 400 vertices, 10 poses.
        EXPECT_DOUBLE_EQ(point.bits_per_vertex_per_pose,
                         8.0 * static_cast<double>(point.size_bytes) / 4000.0);
        EXPECT_EQ(point.visual_error, 0.25);
        EXPECT_EQ(point.frame_ms, 1.0);
        EXPECT_GT(point.encode_s, 0.0);
        EXPECT_GT(point.shared_s, 0.0);
    }
}

TEST_F(SweepTest, ErrorsThatTheBakeCannotReachAreLeftOutWithANote) {
    Sweep sweep(bake_, "sheet", scratch_, {});
    std::vector<TradePoint> points;
    uint64_t num_done = 0;
    sweep.measure_all(4, integers({"10%", "0.1%", "0.01%"}), points,
                      [&](uint64_t n) { num_done += n; });
    EXPECT_EQ(points.size(), 8u);
    EXPECT_EQ(num_done, 24u);
    ASSERT_EQ(sweep.notes().size(), 1u);
    EXPECT_TRUE(sweep.notes()[0].starts_with("4 bands have "));
    EXPECT_TRUE(sweep.notes()[0].ends_with(" % at best: 0.1%, 0.01% are left out"))
        << sweep.notes()[0];
    // Asked for one by one, too.
    EXPECT_FALSE(sweep.measure({4, points[0].settings.codec, Preference::size, "0.1%"}));
    ASSERT_EQ(sweep.notes().size(), 2u);
    EXPECT_TRUE(sweep.notes()[1].starts_with("--max-error 0.1% --codec "));
    EXPECT_NE(sweep.notes()[1].find(" --prefer size --bands 4 is left out: "), std::string::npos);
}

TEST_F(SweepTest, BandsThatDoNotFitInMemoryAreLeftOutWithANote) {
    Sweep sweep(bake_, "sheet", scratch_, {}, 1'000'000);
    std::vector<TradePoint> points;
    uint64_t num_done = 0;
    sweep.measure_all(4, integers({"20%", "10%"}), points, [&](uint64_t n) { num_done += n; });
    EXPECT_TRUE(points.empty());
    EXPECT_EQ(num_done, 16u);
    ASSERT_EQ(sweep.notes().size(), 1u);
    EXPECT_TRUE(sweep.notes()[0].starts_with("4 bands are left out: ")) << sweep.notes()[0];
    EXPECT_NE(sweep.notes()[0].find("--memory allows 1 MB"), std::string::npos);
}

// Without a target, by hand and with components of its own.
EncodeSummary encode_plain_alone(const BakeReader& bake, const TradeSettings& settings,
                                 const std::filesystem::path& output) {
    EncodeOptions options;
    options.precision = settings.precision;
    options.bands = settings.bands;
    options.name = output.stem().string();
    options.measure = true;
    if (settings.max_error.empty()) {
        options.geometry.kind = options.transfer.kind = ComponentChoice::Kind::all;
    } else {
        options.automatic_transfer_error = settings.transfer_error();
    }
    return encode(bake, options, output);
}

TEST_F(SweepTest, PlainPointsAreTheFilesOfSingleEncodesToo) {
    std::vector<std::vector<char>> swept;
    const PlayFile keep = [&](const Asset&) {
        swept.push_back(read_file(scratch_, uint64_t{1} << 30));
        return PlayedFile{0.25, 1.0};
    };
    Sweep sweep(bake_, "sheet", scratch_, keep);
    std::vector<TradePoint> points;
    uint64_t num_done = 0;
    // Points of integers are between them.
    const SweepAxes axes{{"20%"}, {"10%", "2%"}, {Precision::f16, Precision::i16, Precision::f32}};
    sweep.measure_all(4, axes, points, [&](uint64_t n) { num_done += n; });
    ASSERT_EQ(points.size(), 3u + 8 + 3);
    EXPECT_EQ(num_done, num_points(axes));
    EXPECT_EQ(num_points(axes), points.size());
    const std::filesystem::path output = directory_ / "sheet.paim";
    for (const size_t n : {0u, 1u, 2u, 11u, 12u, 13u}) {
        const TradePoint& point = points[n];
        EXPECT_EQ(point.settings.precision, n < 3 ? Precision::f16 : Precision::f32);
        const EncodeSummary summary = encode_plain_alone(bake_, point.settings, output);
        EXPECT_TRUE(swept[n] == read_file(output, uint64_t{1} << 30)) << n;
        EXPECT_EQ(point.size_bytes, swept[n].size());
        EXPECT_EQ(point.transfer_error(), summary.measured->transfer.total());
        EXPECT_EQ(point.transfer_components, summary.transfer_components);
        EXPECT_EQ(point.geometry_components, summary.geometry_components);
        // 4 bands, one channel, coloured light: (K + 1) 16 of the transfer, 48 of the light.
        EXPECT_EQ(point.multiply_adds, (point.transfer_components + 1) * 16 + 48);
        EXPECT_EQ(point.visual_error, 0.25);
        EXPECT_GT(point.encode_s, 0.0);
        EXPECT_EQ(point.shared_s, points[0].shared_s);
    }
    // Cut at 10 % and at 2 %: fewer components err more.
    EXPECT_LT(points[1].transfer_components, points[2].transfer_components);
    EXPECT_LE(points[2].transfer_components, points[0].transfer_components);
    EXPECT_GT(points[1].error.transfer.error_to_bake, points[2].error.transfer.error_to_bake);
}

// All components as floats are the bake, to the rounding of floats: of 24 bits and of 11. Relative errors
// of values are at most half a unit of the last place, and those of sums of a few components of several
// times the size of the result a few times that.
TEST_F(SweepTest, PlainStorageOfAllComponentsErrsByRoundingAlone) {
    Sweep sweep(bake_, "sheet", scratch_, {});
    TradeSettings settings{4, std::string(plain_codec().name), Preference::size, ""};
    for (const auto& [precision, unit] :
         {std::pair{Precision::f32, 0x1p-24}, std::pair{Precision::f16, 0x1p-11}}) {
        settings.precision = precision;
        const std::optional<TradePoint> point = sweep.measure(settings);
        ASSERT_TRUE(point);
        EXPECT_LT(point->error.transfer.error_to_bake, 4 * unit) << precision_name(precision);
        EXPECT_LT(point->error.geometry.relative_rms(), 4 * unit) << precision_name(precision);
        EXPECT_GT(point->error.transfer.error_to_bake, 0.05 * unit) << precision_name(precision);
        // The truth is off by the bake's noise all the same.
        EXPECT_NEAR(point->transfer_error(), point->error.transfer.bake_noise,
                    0.02 * point->transfer_error());
    }
}

// Errors that are no matter of the settings end the sweep.
TEST_F(SweepTest, MistakesAreNoNotes) {
    Sweep sweep(bake_, "sheet", scratch_, {});
    EXPECT_THROW(sweep.measure({4, "no such codec", Preference::size, "10%"}), Error);
    EXPECT_TRUE(sweep.notes().empty());
}

TEST_F(SweepTest, AllButTimesIsTheSameOnAnyNumberOfThreads) {
    std::vector<std::string> tables;
    for (const int num_threads : {1, 2, 2}) {
        const ThreadLimit limit(num_threads);
        Trade trade =
            measure_trade(bake_, {{4, 3}, {"20%", "10%"}, TradeLimit{TradeLimit::Of::error, 0.15}},
                          directory_.path(), {}, true);
        for (TradePoint& point : trade.points) {
            point.encode_s = point.shared_s = 0.0;
        }
        ASSERT_TRUE(trade.best);
        tables.push_back(trade_csv(trade.points) + recommendation_text("sheet.bake", trade));
    }
    EXPECT_EQ(tables[0], tables[1]);
    EXPECT_EQ(tables[1], tables[2]);
}

TEST_F(SweepTest, RefinesUntilTheFileIsNearTheLimit) {
    const TradeLimit limit{TradeLimit::Of::error, 0.15};
    const Trade trade =
        measure_trade(bake_, {{4}, {"20%", "5%"}, limit}, directory_.path(), {}, true);
    ASSERT_TRUE(trade.best && trade.cheapest);
    const TradePoint& best = trade.points[*trade.best];
    EXPECT_EQ(trade.kind, TradeError::transfer);
    EXPECT_TRUE(best.refined);
    EXPECT_LE(best.transfer_error(), 0.15);
    EXPECT_GE(best.transfer_error(), 0.97 * 0.15);
    for (const TradePoint& point : trade.points) {
        if (point.transfer_error() > 0.15) continue;
        EXPECT_GE(point.size_bytes, best.size_bytes);
        EXPECT_GE(point.multiply_adds, trade.points[*trade.cheapest].multiply_adds);
    }
}

TEST_F(SweepTest, BandsBeyondThoseOfTheBakeAreLeftOutWithANote) {
    const Trade trade =
        measure_trade(bake_, {{7, 4, 4, 9}, {"20%", "0.2"}, {}}, directory_.path(), {}, true);
    ASSERT_EQ(trade.notes.size(), 2u);
    EXPECT_EQ(trade.notes[0], "9 bands are left out: the bake has 4");
    EXPECT_EQ(trade.notes[1], "7 bands are left out: the bake has 4");
    // Each once, though 20% is there twice: eight of integers, and of both kinds of floats all components
    // and those of 20%.
    EXPECT_EQ(trade.points.size(), 8u + 2 * 2);
}

}  // namespace
}  // namespace paim
