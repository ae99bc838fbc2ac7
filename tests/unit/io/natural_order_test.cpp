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

TEST(NaturalOrder, KeepsFoldersTogether) {
    // By bytes alone, '-' comes before '/'.
    EXPECT_TRUE(natural_path_less("run/2.obj", "run-a/1.obj"));
    EXPECT_TRUE(natural_path_less("run2/9.obj", "run10/1.obj"));
    EXPECT_TRUE(natural_path_less("run/2.obj", "run/10.obj"));
    EXPECT_FALSE(natural_path_less("run/2.obj", "run/2.obj"));
}

}  // namespace
}  // namespace paim
