// Powers of two for lengths of every size.
#include "paim/mesh/unit_scale.h"

#include <gtest/gtest.h>

#include <limits>

namespace paim {
namespace {

TEST(UnitScale, BringsLengthsToOneToTwo) {
    EXPECT_EQ(unit_scale(1.0), 1.0f);
    EXPECT_EQ(unit_scale(1.999), 1.0f);
    EXPECT_EQ(unit_scale(2.0), 0.5f);
    EXPECT_EQ(unit_scale(0.75), 2.0f);
    EXPECT_EQ(unit_scale(0x1.8p90), 0x1p-90f);
    EXPECT_EQ(unit_scale(0x1.8p-90), 0x1p90f);
}

TEST(UnitScale, IsANormalFloatWhateverTheLength) {
    // Where 2^±126 is not enough, the length is brought as near to 1 as it goes.
    EXPECT_EQ(unit_scale(static_cast<double>(std::numeric_limits<float>::max())), 0x1p-126f);
    EXPECT_EQ(unit_scale(static_cast<double>(std::numeric_limits<float>::denorm_min())), 0x1p126f);
    EXPECT_EQ(unit_scale(0.0), 1.0f);
    EXPECT_EQ(unit_scale(std::numeric_limits<double>::infinity()), 1.0f);
    EXPECT_EQ(unit_scale(std::numeric_limits<double>::quiet_NaN()), 1.0f);
}

}  // namespace
}  // namespace paim
