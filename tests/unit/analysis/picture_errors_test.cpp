// Errors of pictures and their spread, by hand.
#include "analysis/picture_errors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace paim {
namespace {

ImageError error_of(double absolute, double reference) {
    ImageError error;
    error.absolute_sum = absolute;
    error.reference_sum = reference;
    return error;
}

TEST(PictureErrors, SpreadIsThatOfSinglePictures) {
    PictureErrors errors;
    errors.add(error_of(1.0, 10.0), 3, 0);
    errors.add(error_of(3.0, 10.0), 3, 1);
    errors.add(error_of(2.0, 10.0), 7, 0);
    errors.add(error_of(3.0, 10.0), 7, 1);  // as bad as the worst before it
    errors.add(error_of(0.0, 0.0), 9, 0);   // a black picture
    const PictureErrors::Spread spread = errors.spread();
    EXPECT_DOUBLE_EQ(errors.visual_error(), 9.0 / 40.0);
    EXPECT_DOUBLE_EQ(spread.least, 0.1);
    EXPECT_DOUBLE_EQ(spread.median, 0.3);  // the upper one of the two in the middle
    EXPECT_DOUBLE_EQ(spread.most, 0.3);
    // Deviations from 0.225: −0.125, 0.075, −0.025, 0.075; three degrees of freedom.
    EXPECT_NEAR(spread.deviation, std::sqrt(0.0275 / 3.0), 1e-15);
    EXPECT_EQ(spread.worst_pose, 3u);
    EXPECT_EQ(spread.worst_view, 1u);
}

TEST(PictureErrors, OnePictureDoesNotSpread) {
    PictureErrors errors;
    errors.add(error_of(1.0, 4.0), 2, 5);
    EXPECT_EQ(errors.spread().deviation, 0.0);
    EXPECT_EQ(errors.spread().least, errors.spread().most);
}

TEST(PictureErrors, WithoutPicturesNothingIsANumber) {
    PictureErrors errors;
    errors.add(error_of(0.0, 0.0), 0, 0);
    EXPECT_TRUE(std::isnan(errors.visual_error()));
    EXPECT_TRUE(std::isnan(errors.spread().most));
    EXPECT_TRUE(std::isnan(errors.spread().median));
}

}  // namespace
}  // namespace paim
