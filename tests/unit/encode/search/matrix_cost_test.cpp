// What matrices cost, where it is known beforehand.
#include "compressor/encode/search/matrix_cost.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"

namespace paim {
namespace {

// A table entry of a section (docs/format.md), and half of the alignment of 64 bytes.
constexpr uint64_t kSectionBytes = 64 + 32;

LowRank one_plane(StoredValues mean, std::vector<StoredValues> components = {}) {
    LowRank matrix;
    matrix.num_points = static_cast<uint32_t>(mean.size());
    matrix.num_planes = 1;
    matrix.num_poses = 7;
    matrix.num_components = static_cast<uint32_t>(components.size());
    matrix.weights.resize(size_t{7} * components.size());
    matrix.mean = std::move(mean);
    matrix.components = std::move(components);
    return matrix;
}

TEST(MatrixCost, OfFloatsIsTheirBytesAndOfWeightsOneByteEach) {
    const std::vector<float> values(100, 0.25f);
    const LowRank matrix = one_plane(values, {StoredValues(values), StoredValues(values)});
    EXPECT_EQ(stored_bytes(matrix, PlanePredictor(), Effort::fast),
              3 * (kSectionBytes + 400) + 2 * 7);
}

// Numbers that are as likely as each other take the logarithm of their count, and no code takes
// less. Huffman codes of so many symbols lose less than 1 %, Zstandard takes bytes as they are
// where a code would save less than a 64th, and tables and headers are some 100 bytes.
TEST(MatrixCost, OfNoiseIsItsEntropy) {
    RandomStream random(3);
    constexpr size_t kNum = 200000;
    for (const int largest : {1, 2, 7, 60}) {
        std::vector<int8_t> values(kNum);
        for (int8_t& value : values) {
            value = static_cast<int8_t>(std::floor(random.uniform() * (2 * largest + 1)) - largest);
        }
        const double entropy_bytes = std::log2(2 * largest + 1) * kNum / 8.0;
        const auto bytes =
            static_cast<double>(stored_bytes(one_plane(values), PlanePredictor(), Effort::fast));
        EXPECT_GT(bytes, entropy_bytes) << largest;
        EXPECT_LT(bytes, (1.01 + 1.0 / 64.0) * entropy_bytes + 300.0) << largest;
    }
}

TEST(MatrixCost, OfNothingIsItsSections) {
    const std::vector<int8_t> zeros(200000, 0);
    const uint64_t bytes =
        stored_bytes(one_plane(zeros, {StoredValues(zeros)}), PlanePredictor(), Effort::fast);
    EXPECT_GT(bytes, 2 * kSectionBytes);
    EXPECT_LT(bytes, 2 * (kSectionBytes + 40) + 7);  // a frame's header and a plane's
}

}  // namespace
}  // namespace paim
