// Positions that are made better until frames of gloss are good enough.
#include "compressor/encode/search/frame_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "compressor/encode/search/feasibility.h"
#include "paim/base/error.h"

namespace paim {
namespace {

// An encoder whose faces turn by as much as they may, and frames whose error grows with that.
struct Encoder {
    double error_per_degree = 0.01;
    double floor = 0.0;             // of the error of frames
    double smallest_angle_deg = 0;  // that it can do
    std::vector<double> asked_deg;  // of each file

    FramedSummary encode(double most) {
        EncodeTarget target;
        target.normal_angle_deg = 5.0;
        return encode_for_frames(
            target, most,
            [&](const EncodeTarget& next) {
                asked_deg.push_back(*next.normal_angle_deg);
                if (asked_deg.back() < smallest_angle_deg) throw_infeasible("an angle too small");
                TargetSummary summary;
                summary.error.shape.worst.normal_angle_deg = asked_deg.back();
                summary.targets.surface.normal_angle_deg = asked_deg.back();
                return summary;
            },
            [&] { return std::max(floor, error_per_degree * asked_deg.back()); });
    }
    std::string complaint(double most) {
        try {
            encode(most);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
            return error.what();
        }
        return "nothing";
    }
};

TEST(FrameFit, TakesTheFirstFileThatIsGoodEnough) {
    Encoder encoder;
    EXPECT_DOUBLE_EQ(encoder.encode(0.06).frame_error, 0.05);
    EXPECT_EQ(encoder.asked_deg, std::vector<double>{5.0});
}

TEST(FrameFit, AsksForAngleInProportion) {
    Encoder encoder;
    const FramedSummary summary = encoder.encode(0.01);
    ASSERT_EQ(encoder.asked_deg.size(), 2u);
    EXPECT_LE(summary.frame_error, 0.01);
    // A little less than needed.
    EXPECT_GT(encoder.asked_deg[1], 0.8);
    EXPECT_LT(encoder.asked_deg[1], 1.0);
}

// The error that frames keep is named, and the one that gloss could have.
TEST(FrameFit, SaysWhatItCannotReach) {
    Encoder bent;
    bent.floor = 0.03;
    const std::string text = bent.complaint(0.01);
    EXPECT_NE(text.find("leave an error of 3 %"), std::string::npos) << text;
    EXPECT_NE(text.find("--max-gloss-error of 7 %"), std::string::npos) << text;
    Encoder coarse;
    coarse.smallest_angle_deg = 2.0;
    EXPECT_NE(coarse.complaint(0.01).find("leave an error of 5 %"), std::string::npos);
    // A target that cannot be met without gloss either is refused as it is.
    Encoder impossible;
    impossible.smallest_angle_deg = 9.0;
    EXPECT_EQ(impossible.complaint(0.01), "an angle too small");
}

}  // namespace
}  // namespace paim
