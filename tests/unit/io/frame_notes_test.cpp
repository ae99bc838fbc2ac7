// Gaps and frame numbers that are there twice, in names of many forms.
#include "compressor/io/frame_notes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compressor/io/natural_order.h"

namespace paim {
namespace {

using Lines = std::vector<std::string>;

Lines notes(const Lines& names) {
    std::vector<std::filesystem::path> files;
    for (const std::string& name : names) files.push_back("dir/" + name + ".obj");
    sort_naturally(files);
    Lines lines;
    append_frame_notes(files, lines);
    return lines;
}

TEST(FrameNotes, NamesWhatIsMissing) {
    EXPECT_EQ(notes({"t_0001", "t_0002", "t_0003", "t_0004", "t_0008", "t_0009"}),
              (Lines{"dir/t_0001.obj to t_0009.obj: frames 5 to 7 are missing"}));
    EXPECT_EQ(notes({"t1", "t2", "t4"}), (Lines{"dir/t1.obj to t4.obj: frame 3 is missing"}));
    EXPECT_EQ(notes({"t-003", "t-002", "t0000", "t0003"}),
              (Lines{"dir/t-003.obj to t0003.obj: frames -1, 1 to 2 are missing"}));
    // Every tenth frame, and frames with fractions.
    EXPECT_EQ(notes({"t0", "t10", "t20", "t50"}),
              (Lines{"dir/t0.obj to t50.obj: frames 30 to 40 are missing"}));
    EXPECT_EQ(notes({"t.1", "t.1.25", "t.1.5", "t.2", "t.2.25"}),
              (Lines{"dir/t.1.obj to t.2.25.obj: frame 1.75 is missing"}));
    EXPECT_EQ(notes({"t.1", "t.1.25", "t.1.5", "t.1.75", "t.2", "t.3"}),
              (Lines{"dir/t.1.obj to t.3.obj: frames 2.25 to 2.75 are missing"}));
}

TEST(FrameNotes, LooksAtEachRowAlone) {
    EXPECT_EQ(notes({"shot-2-frame-9", "shot-2-frame-10", "shot-2-frame-12", "shot-7-frame-1"}),
              (Lines{"dir/shot-2-frame-9.obj to shot-2-frame-12.obj: frame 11 is missing"}));
    // The last number that differs is that of the frame.
    EXPECT_EQ(notes({"w_1_v3", "w_2_v3", "w_5_v3"}),
              (Lines{"dir/w_1_v3.obj to w_5_v3.obj: frames 3 to 4 are missing"}));
}

TEST(FrameNotes, SaysNothingWhereNothingIsOdd) {
    EXPECT_EQ(notes({"t1", "t2", "t3"}), Lines{});
    EXPECT_EQ(notes({"t-2", "t-1", "t0", "t1"}), Lines{});
    EXPECT_EQ(notes({"walk-01", "walk-02", "walk-03"}), Lines{});
    EXPECT_EQ(notes({"t10", "t20", "t30"}), Lines{});
    EXPECT_EQ(notes({"t1", "t12", "t40"}), Lines{});  // hand-picked
    EXPECT_EQ(notes({"t1", "t100"}), Lines{});
    EXPECT_EQ(notes({"t1.33", "t1.67", "t2.0", "t2.33"}), Lines{});  // thirds, rounded
    EXPECT_EQ(notes({"a", "b"}), Lines{});
    EXPECT_EQ(notes({"a_1_1", "a_1_2", "a_2_1", "a_2_2"}), Lines{});
}

TEST(FrameNotes, NamesFramesThatAreThereTwice) {
    EXPECT_EQ(notes({"t_5", "t_05", "t_6"}), (Lines{"dir/t_5.obj: frame 5 is also in t_05.obj"}));
    EXPECT_EQ(notes({"t_05", "t_5"}), (Lines{"dir/t_5.obj: frame 5 is also in t_05.obj"}));
    EXPECT_EQ(notes({"t_1", "t_2", "t_2 (1)", "t_3"}),
              (Lines{"dir/t_2 (1).obj: frame 2 is also in t_2.obj"}));
    EXPECT_EQ(notes({"t_1", "t_2", "t_3", "t_3_old", "t_4"}),
              (Lines{"dir/t_3_old.obj: frame 3 is also in t_3.obj"}));
}

TEST(FrameNotes, IsShort) {
    Lines names;
    for (int i = 0; i < 50; ++i) names.push_back(fmt::format("t{}", i + (i / 5) * (i / 5)));
    for (int i = 0; i < 20; ++i) {
        names.push_back(fmt::format("x_{}", i));
        names.push_back(fmt::format("x_0{}", i));
    }
    const Lines lines = notes(names);
    ASSERT_EQ(lines.size(), 9u);
    EXPECT_EQ(lines.back(), "13 more notes about frame numbers");
    for (const std::string& line : lines) EXPECT_LT(line.size(), 120u) << line;
}

}  // namespace
}  // namespace paim
