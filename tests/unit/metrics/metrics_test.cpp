// Errors of spectra, images and arrays on numbers small enough to work out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "paim/metrics/array_error.h"
#include "paim/metrics/image_error.h"
#include "paim/metrics/singular_value_error.h"

namespace paim {
namespace {

TEST(Spectrum, ErrorsOfDroppedComponents) {
    const std::vector<double> s{4.0, 3.0, 0.0};
    EXPECT_DOUBLE_EQ(theory_error(s, 0), 1.0);
    EXPECT_DOUBLE_EQ(theory_error(s, 1), 3.0 / 7.0);
    EXPECT_DOUBLE_EQ(energy_error(s, 1), 3.0 / 5.0);
    EXPECT_DOUBLE_EQ(theory_error(s, 2), 0.0);
    EXPECT_DOUBLE_EQ(energy_error(s, 9), 0.0);
}

TEST(Spectrum, StillAnimationsAndExtremesAreFinite) {
    EXPECT_EQ(theory_error(std::vector<double>{}, 0), 0.0);
    EXPECT_EQ(energy_error(std::vector<double>{0.0, 0.0}, 0), 0.0);
    EXPECT_DOUBLE_EQ(energy_error(std::vector<double>{4e200, 3e200}, 1), 0.6);
    EXPECT_DOUBLE_EQ(energy_error(std::vector<double>{4e-200, 3e-200}, 1), 0.6);
}

TEST(ImageError, SumsAndFindsTheWorstPixel) {
    Image reference(2, 2, Vec3f(1, 1, 1));
    Image image = reference;
    image.at(1, 0) = Vec3f(1.5f, 1, 0.75f);
    const ImageError error = compare_images(image, reference);
    EXPECT_DOUBLE_EQ(error.visual_error(), 0.75 / 12.0);
    EXPECT_DOUBLE_EQ(error.worst, 0.5);
    EXPECT_EQ(error.worst_x, 1);
    EXPECT_EQ(error.worst_y, 0);
    EXPECT_EQ(compare_images(reference, reference).visual_error(), 0.0);
    EXPECT_TRUE(std::isinf(compare_images(reference, Image(2, 2)).visual_error()));
}

// Over the channels of pixels that either image shows: here one pixel of each, and one of both.
TEST(ImageError, MeanSquaresAreOfWhatIsShown) {
    Image reference(4, 1), image(4, 1);
    reference.at(0, 0) = Vec3f(2, 0, 0);
    image.at(1, 0) = Vec3f(0, 0, 1);
    reference.at(2, 0) = Vec3f(1, 1, 1);
    image.at(2, 0) = Vec3f(1, 1, 4);
    const ImageError error = compare_images(image, reference);
    // Squares 4, 1 and 9 over nine values; the peak is 2.
    EXPECT_DOUBLE_EQ(error.rmse(), std::sqrt(14.0 / 9.0));
    EXPECT_DOUBLE_EQ(error.psnr_db(), 10.0 * std::log10(4.0 * 9.0 / 14.0));
    ImageError twice = error;
    twice.add(error);
    EXPECT_DOUBLE_EQ(twice.rmse(), error.rmse());
    EXPECT_DOUBLE_EQ(twice.psnr_db(), error.psnr_db());
    EXPECT_TRUE(std::isinf(compare_images(image, image).psnr_db()));
    EXPECT_TRUE(std::isnan(compare_images(Image(2, 2), Image(2, 2)).rmse()));
    EXPECT_TRUE(std::isnan(compare_images(Image(2, 2), Image(2, 2)).psnr_db()));
    EXPECT_LT(compare_images(image, Image(4, 1)).psnr_db(), -1e300);
}

// In black pictures nothing is to be seen, so that no error was measured: 0 would say that nothing
// is lost.
TEST(ImageError, OfBlackPicturesIsNoNumber) {
    ImageError error;
    EXPECT_TRUE(std::isnan(error.visual_error()));
    error.add(compare_images(Image(2, 2), Image(2, 2)));
    EXPECT_TRUE(std::isnan(error.visual_error()));
    // One picture that is not black is enough.
    const Image grey(2, 2, Vec3f(1, 1, 1));
    error.add(compare_images(grey, grey));
    EXPECT_EQ(error.visual_error(), 0.0);
}

TEST(ArrayError, OfNothingIsNoNumber) {
    ArrayError error;
    EXPECT_TRUE(std::isnan(error.rms()));
    EXPECT_TRUE(std::isnan(error.relative()));
    EXPECT_TRUE(std::isnan(DistanceError().rms()));
    // Zeros that were compared with zeros differ by nothing.
    error.add(std::vector<float>{0, 0}, std::vector<float>{0, 0}, 0);
    EXPECT_EQ(error.rms(), 0.0);
    EXPECT_EQ(error.relative(), 0.0);
}

TEST(ArrayError, RelativeRmsAndWorst) {
    ArrayError error;
    error.add(std::vector<float>{1, 2}, std::vector<float>{1, 2}, 0);
    error.add(std::vector<float>{3, 0}, std::vector<float>{0, 4}, 1);
    EXPECT_DOUBLE_EQ(error.rms(), std::sqrt(25.0 / 4));
    EXPECT_DOUBLE_EQ(error.relative(), std::sqrt(25.0 / 21));
    EXPECT_EQ(error.worst, 4.0);
    EXPECT_EQ(error.worst_index, 1u);
    EXPECT_EQ(error.worst_pose, 1u);
}

TEST(DistanceError, MeasuresPointsNotCoordinates) {
    DistanceError error;
    error.add(std::vector<float>{0, 3, 0, 4, 0, 0}, std::vector<float>{0, 0, 0, 0, 0, 0}, 3);
    EXPECT_DOUBLE_EQ(error.worst, 5.0);
    EXPECT_EQ(error.worst_vertex, 1u);
    EXPECT_EQ(error.worst_pose, 3u);
    EXPECT_DOUBLE_EQ(error.rms(), std::sqrt(25.0 / 2));
}

TEST(ArrayError, WhatIsNotANumberIsTheWorst) {
    ArrayError error;
    const float none = std::numeric_limits<float>::quiet_NaN();
    error.add(std::vector<float>{1, none, 9}, std::vector<float>{0, 0, 0}, 0);
    EXPECT_TRUE(std::isnan(error.worst));
    EXPECT_TRUE(std::isnan(error.relative()));
    EXPECT_EQ(error.worst_index, 1u);
}

}  // namespace
}  // namespace paim
