// Sweeps over a small bake: points are the files that encode_to_target() makes.
#include "analysis/trade/sweep.h"

#include <gtest/gtest.h>

#include "analysis/trade/table.h"
#include "analysis/trade/trade.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/tbb_parallel.h"
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
    sweep.measure_all(4, {"20%", "5%"}, points, [&](uint64_t n) { num_done += n; });
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
    sweep.measure_all(4, {"10%", "0.1%", "0.01%"}, points, [&](uint64_t n) { num_done += n; });
    EXPECT_EQ(points.size(), 8u);
    EXPECT_EQ(num_done, 24u);
    ASSERT_EQ(sweep.notes().size(), 1u);
    EXPECT_TRUE(sweep.notes()[0].starts_with("4 bands have "));
    EXPECT_TRUE(sweep.notes()[0].ends_with(" % at best: 0.1%, 0.01% are left out"))
        << sweep.notes()[0];
    // Asked for one by one, too.
    EXPECT_FALSE(sweep.measure({4, points[0].settings.codec, Preference::size, "0.1%"}));
    ASSERT_EQ(sweep.notes().size(), 2u);
    EXPECT_TRUE(sweep.notes()[1].starts_with("4 bands, --max-error 0.1%, --codec "));
    EXPECT_NE(sweep.notes()[1].find("is left out: "), std::string::npos);
}

TEST_F(SweepTest, BandsThatDoNotFitInMemoryAreLeftOutWithANote) {
    Sweep sweep(bake_, "sheet", scratch_, {}, 1'000'000);
    std::vector<TradePoint> points;
    uint64_t num_done = 0;
    sweep.measure_all(4, {"20%", "10%"}, points, [&](uint64_t n) { num_done += n; });
    EXPECT_TRUE(points.empty());
    EXPECT_EQ(num_done, 16u);
    ASSERT_EQ(sweep.notes().size(), 1u);
    EXPECT_TRUE(sweep.notes()[0].starts_with("4 bands are left out: ")) << sweep.notes()[0];
    EXPECT_NE(sweep.notes()[0].find("--memory allows 1 MB"), std::string::npos);
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
    // Each once, though 20% is there twice.
    EXPECT_EQ(trade.points.size(), 8u);
}

}  // namespace
}  // namespace paim
