// Bounds of decoded values: never exceeded, and the same in pieces.
#include "paim/codec/magnitude_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "paim/base/half.h"
#include "tests/example_asset.h"

namespace paim {
namespace {

std::vector<double> bounds_in_pieces(const LowRank& matrix, size_t rows_at_once) {
    StreamedMagnitudes streamed(matrix);
    for (size_t first = 0; first < matrix.num_rows(); first += rows_at_once) {
        const size_t count = std::min(rows_at_once, matrix.num_rows() - first);
        std::vector<std::span<const float>> components;
        for (const StoredValues& component : matrix.components) {
            components.push_back(std::span(component.floats()).subspan(first, count));
        }
        streamed.add(std::span(matrix.mean.floats()).subspan(first, count), components);
    }
    return streamed.bounds();
}

TEST(MagnitudeBounds, AreNotExceededAndTheSameInPieces) {
    const Asset asset = make_example_asset(3, 1, 5, 4);
    for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
        const LowRank& matrix = asset.moving().attribute(attribute);
        const std::vector<double> bounds = magnitude_bounds(matrix);
        ASSERT_EQ(bounds.size(), matrix.num_planes);
        for (size_t row = 0; row < matrix.num_rows(); ++row) {
            for (size_t p = 0; p < matrix.num_poses; ++p) {
                double value = double{matrix.mean[row]};
                for (size_t k = 0; k < matrix.num_components; ++k) {
                    value += double{matrix.weights[k * matrix.num_poses + p]} *
                             double{matrix.components[k][row]};
                }
                EXPECT_LE(std::abs(value), bounds[row / matrix.num_points] + 1e-12);
            }
        }
        // Less than a plane, a plane, and several at once.
        for (const size_t rows : {size_t{1}, size_t{3}, size_t{4}, size_t{7}, matrix.num_rows()}) {
            EXPECT_EQ(bounds_in_pieces(matrix, rows), bounds) << rows;
        }
    }
}

TEST(MagnitudeBounds, InPiecesAreThoseOfHalfFloats) {
    Asset asset = make_example_asset();
    LowRank& matrix = asset.moving().positions;
    matrix.precision = Precision::f16;
    const std::vector<double> in_pieces = bounds_in_pieces(matrix, 5);
    EXPECT_NE(in_pieces, magnitude_bounds(matrix));
    for (StoredValues& component : matrix.components) {
        std::vector<float> halves = component.floats();
        for (float& value : halves) value = from_half(to_half(value));
        component = halves;
    }
    EXPECT_EQ(in_pieces, magnitude_bounds(matrix));
}

TEST(MagnitudeBounds, OfWhatIsNotFiniteAreNotFinite) {
    for (const float odd : {NAN, HUGE_VALF, -HUGE_VALF}) {
        LowRank matrix = make_example_asset().moving().positions;
        std::vector<float> values = matrix.components[1].floats();
        values[9] = odd;
        matrix.components[1] = values;
        EXPECT_FALSE(std::isfinite(magnitude_bounds(matrix)[2])) << odd;
        EXPECT_FALSE(std::isfinite(bounds_in_pieces(matrix, 5)[2])) << odd;
        EXPECT_TRUE(std::isfinite(bounds_in_pieces(matrix, 5)[1])) << odd;
    }
}

}  // namespace
}  // namespace paim
