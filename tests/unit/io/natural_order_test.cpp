// Natural order: numbers of any length, ties, paths.
#include "compressor/io/natural_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace paim {
namespace {

TEST(NaturalOrder, ComparesNumbersAsNumbers) {
    EXPECT_TRUE(natural_less("x_2", "x_10"));
    EXPECT_FALSE(natural_less("x_10", "x_2"));
    EXPECT_TRUE(natural_less("wolf-9.obj", "wolf-10.obj"));
    EXPECT_TRUE(natural_less("a1b9", "a1b10"));
    EXPECT_TRUE(natural_less("x", "x1"));
    EXPECT_TRUE(natural_less("", "x"));
    // Far beyond 64 bits.
    EXPECT_TRUE(natural_less("x99999999999999999999999", "x100000000000000000000000"));
    EXPECT_TRUE(natural_less("x100000000000000000000000", "x100000000000000000000001"));
}

TEST(NaturalOrder, BreaksTiesByBytes) {
    EXPECT_TRUE(natural_less("x_02", "x_2"));
    EXPECT_FALSE(natural_less("x_2", "x_02"));
    EXPECT_TRUE(natural_less("x_02", "x_3"));
    EXPECT_TRUE(natural_less("x_2", "x_03"));
    EXPECT_TRUE(natural_less("x_0", "x_00"));
    EXPECT_FALSE(natural_less("same", "same"));
}

TEST(NaturalOrder, IsATotalOrder) {
    std::vector<std::string> names;
    for (const char* a : {"", "0", "00", "1", "01", "10", "a", "a0", "a00b2", "a0b10", "-", "~"}) {
        for (const char* b : {"", "2", "02", "x"}) names.push_back(std::string(a) + b);
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end(), natural_less);
    for (size_t i = 0; i < sorted.size(); ++i) {
        for (size_t k = 0; k < sorted.size(); ++k) {
            EXPECT_EQ(natural_less(sorted[i], sorted[k]), i < k) << sorted[i] << " " << sorted[k];
        }
    }
}

// The names in the order that sort_naturally() gives, whatever order they come in.
std::vector<std::string> sorted(const std::vector<std::string>& names) {
    std::vector<std::string> result;
    std::vector<std::string> shuffled = names;
    for (size_t turn = 0; turn < names.size(); ++turn) {
        std::vector<std::filesystem::path> paths(shuffled.begin(), shuffled.end());
        sort_naturally(paths);
        const std::vector<std::string> now(paths.begin(), paths.end());
        EXPECT_TRUE(result.empty() || result == now);
        result = now;
        // Another order: every third name, then the others backwards.
        std::rotate(shuffled.begin(), shuffled.begin() + 1, shuffled.end());
        if (turn % 2 == 1) std::reverse(shuffled.begin(), shuffled.end() - 1);
    }
    return result;
}

// Sorts the names, which are given in the right order.
void expect_order(const std::vector<std::string>& names) {
    EXPECT_EQ(sorted(names), names);
}

TEST(NaturalOrder, KeepsFoldersTogether) {
    // By bytes alone, '-' comes before '/'.
    expect_order(
        {"run/2.obj", "run/10.obj", "run/a/1.obj", "run-a/1.obj", "run2/9.obj", "run10/1.obj"});
    expect_order({"x.obj", "x1.obj", "x1a.obj", "a/1.obj"});
}

TEST(NaturalOrder, TakesHyphensAsSignsWhereOtherNamesShowIt) {
    // Blender pads to a width that counts the sign.
    expect_order({"t-004.obj", "t-003.obj", "t-001.obj", "t0000.obj", "t0002.obj", "t0010.obj"});
    expect_order({"t-010.obj", "t-002.obj", "t0002.obj", "t0010.obj"});
    // No zero and no padding, but the step goes on.
    expect_order({"f-3.obj", "f-1.obj", "f1.obj", "f3.obj"});
    expect_order({"f-10.obj", "f-5.obj", "f0.obj", "f5.obj", "f10.obj"});
    // Nothing is in front that could be separated.
    expect_order({"-10.obj", "-2.obj", "-1.obj"});
    expect_order({"a_-12.obj", "a_-3.obj"});
    expect_order({"a.-012.obj", "a.-003.obj", "a.0000.obj"});
    expect_order({"a--2.obj", "a--1.obj", "a-0.obj", "a-1.obj"});
    // Several numbers, of which one has signs.
    expect_order({"cam2-f-2.obj", "cam2-f-1.obj", "cam2-f0.obj", "cam10-f-2.obj", "cam10-f0.obj"});
}

// Exporters put the frame right behind a name that ends in a digit, too.
TEST(NaturalOrder, TakesHyphensAsSignsBehindDigitsWhereOtherNamesShowIt) {
    expect_order({"walk2-002.obj", "walk2-001.obj", "walk20000.obj", "walk20001.obj"});
    expect_order(
        {"walk2-10.obj", "walk2-2.obj", "walk2-1.obj", "walk20.obj", "walk21.obj", "walk210.obj"});
    expect_order({"walk2-003.obj", "walk20002.obj"});
    expect_order({"walk2-010.obj", "walk2-002.obj", "walk20000.obj", "walk29999.obj",
                  "walk210000.obj", "walk210001.obj"});
    expect_order({"walk2-200.obj", "walk2-100.obj", "walk20000.obj", "walk20100.obj"});
    expect_order({"a2-001_b.obj", "a20000_b.obj", "a10-001_b.obj", "a100000_b.obj"});
    expect_order({"cam-1-001.obj", "cam-10000.obj", "cam-10001.obj", "cam-2-001.obj"});
    expect_order({"2-001.obj", "20000.obj", "20001.obj"});
    expect_order({"t2-001.5.obj", "t2-001.obj", "t2-000.5.obj", "t20000.obj", "t20000.5.obj"});
    // Other sequences in the folder.
    expect_order({"walk.obj", "walk1.obj", "walk2-002.obj", "walk2-001.obj", "walk20000.obj",
                  "walk20001.obj", "walk3-1.obj", "walk30.obj"});
}

TEST(NaturalOrder, TakesHyphensBehindDigitsAsSeparatorsElsewhere) {
    expect_order({"shot2-001.obj", "shot2-002.obj"});
    expect_order({"shot2-001.obj", "shot2-002.obj", "shot3-001.obj", "shot10-001.obj"});
    // Frames count from 0, or have another width.
    expect_order({"shot2-000.obj", "shot2-001.obj", "shot20001.obj"});
    expect_order({"shot2-0001.obj", "shot2-0002.obj", "shot20001.obj"});
    // Parts of shot 1 among other shots.
    expect_order({"x1-1.obj", "x1-2.obj", "x2.obj", "x10.obj", "x11.obj"});
    expect_order({"x1.obj", "x1-1.obj", "x1-2.obj", "x10.obj", "x11.obj"});
    expect_order({"x1-1.obj", "x1-2.obj", "x10.obj"});
    expect_order({"x1-1.obj", "x1-2.obj", "x99.obj", "x100.obj", "x101.obj"});
    expect_order({"x1-10.obj", "x1-20.obj", "x1100.obj", "x1110.obj"});
    expect_order({"2024-01-01.obj", "2024-01-02.obj", "202401.obj"});
    // Another take.
    expect_order({"walk-01.obj", "walk-02.obj", "walk2-01.obj", "walk2-02.obj"});
}

TEST(NaturalOrder, TakesHyphensAsSeparatorsElsewhere) {
    expect_order({"walk-01.obj", "walk-02.obj", "walk-09.obj", "walk-10.obj"});
    expect_order({"walk-0.obj", "walk-1.obj", "walk-2.obj", "walk-10.obj"});
    expect_order({"a-b-3.obj", "a-b-20.obj", "a-c-1.obj"});
    expect_order({"shot-2-frame-9.obj", "shot-2-frame-10.obj", "shot-10-frame-1.obj"});
    expect_order({"2024-01-02.obj", "2024-01-10.obj", "2024-02-01.obj"});
    expect_order({"x1-2.obj", "x1-10.obj", "x2-1.obj"});
    expect_order({"walk -1.obj", "walk -2.obj"});
    // Another take in the folder, and names that begin with zero, are no frames 0.
    expect_order({"horse-01.obj", "horse-02.obj", "horse-03.obj", "horse7.obj"});
    expect_order({"walk.obj", "walk-1.obj", "walk-2.obj"});
    expect_order({"a_-00.obj", "a_-01.obj", "a_-02.obj"});
}

TEST(NaturalOrder, TakesPointsAsDecimalWhereOtherNamesShowIt) {
    expect_order({"t.1.obj", "t.1.25.obj", "t.1.5.obj", "t.1.75.obj", "t.2.obj", "t.10.obj"});
    expect_order({"t1.0.obj", "t1.25.obj", "t1.5.obj", "t2.0.obj", "t10.0.obj"});
    expect_order({"t_0001.05.obj", "t_0001.1.obj", "t_0001.15.obj"});
    expect_order({"t_0001.obj", "t_0001.125.obj", "t_0001.5.obj", "t_0002.obj"});
    expect_order({"t-1.5.obj", "t-1.25.obj", "t-1.obj", "t-0.5.obj", "t0.obj", "t0.25.obj",
                  "t0.5.obj", "t1.obj"});
    expect_order({"v.2.1.obj", "v.2.1.25.obj", "v.2.1.5.obj", "v.2.2.obj", "v.10.1.obj"});
}

TEST(NaturalOrder, TakesPointsAsSeparatorsElsewhere) {
    expect_order({"walk.v1.0001.obj", "walk.v1.0010.obj", "walk.v2.0001.obj"});
    expect_order({"walk.1.2.obj", "walk.1.10.obj", "walk.2.1.obj"});
    expect_order({"v.1.obj", "v.1.5.obj", "v.1.9.obj", "v.1.10.obj"});
    expect_order({"a.1.2.3.obj", "a.1.2.20.obj", "a.1.10.3.obj"});
    expect_order({"t.0001.obj", "t.0002.obj", "t.0010.obj"});
}

TEST(NaturalOrder, BreaksTiesOfSortedFilesByBytes) {
    expect_order({"x_02.OBJ", "x_02.obj", "x_2.obj", "x_03.obj"});
}

}  // namespace
}  // namespace paim
