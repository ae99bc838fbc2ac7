// Sums of rows of clusters' bases: every vector unit of this machine against the plain loop, bit
// for bit.
#include "paim/codec/cpca/basis_table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "paim/base/seed.h"
#include "tests/float_bits.h"

namespace paim {
namespace {

struct Clustered {
    uint32_t num_clusters = 5;
    uint32_t num_components = 0;
    std::vector<uint32_t> cluster;
    std::vector<StoredValues> coefficients;
    std::vector<float> scales;
    std::vector<float> rows;  // [planes][rows]
};

// Coefficients are i16, i8 and float in turns.
Clustered random_clustered(uint32_t num_vertices, uint32_t num_planes, uint32_t num_components) {
    RandomStream random(num_vertices + num_planes);
    const auto number = [&](double limit) { return limit * (2.0 * random.uniform() - 1.0); };
    Clustered result;
    result.num_components = num_components;
    result.cluster.resize(num_vertices);
    for (uint32_t& c : result.cluster) c = static_cast<uint32_t>(4.999 * random.uniform());
    for (uint32_t j = 0; j < num_components; ++j) {
        const auto fill = [&]<typename T>(std::vector<T> values, double limit) {
            for (T& value : values) value = static_cast<T>(number(limit));
            result.coefficients.emplace_back(std::move(values));
        };
        if (j % 3 == 0) fill(std::vector<int16_t>(num_vertices), 32768.0);
        if (j % 3 == 1) fill(std::vector<int8_t>(num_vertices), 128.0);
        if (j % 3 == 2) fill(std::vector<float>(num_vertices), 2.0);
    }
    result.scales.resize(size_t{result.num_clusters} * (1 + num_components));
    for (float& scale : result.scales) scale = static_cast<float>(number(2.0));
    result.rows.resize(result.scales.size() * num_planes);
    for (float& row : result.rows) row = static_cast<float>(number(1.0));
    return result;
}

std::vector<float> values(const BasisTable& table) {
    return {table.values.begin(), table.values.end()};
}

TEST(BasisTable, IsScaledAndPaddedWithZeros) {
    BasisTable table;
    table.assign(std::vector<float>{1, 2, 3, 4, 5, 6}, std::vector<float>{10, 100});
    EXPECT_EQ(table.num_planes, 3u);
    EXPECT_EQ(table.padded_planes, 4u);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(table.values.data()) % 64, 0u);
    EXPECT_EQ(values(table), (std::vector<float>{10, 30, 50, 0, 200, 400, 600, 0}));
    // What was there before is gone, padding too.
    table.assign(std::vector<float>{1, 2}, std::vector<float>{10, 100});
    EXPECT_EQ(values(table), (std::vector<float>{10, 0, 0, 0, 200, 0, 0, 0}));
}

TEST(Combine, IsTheSumItStandsFor) {
    BasisTable table;
    // Two clusters of a mean and one component, two planes.
    table.assign(std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}, std::vector<float>{1, 1, 1, 1});
    const std::vector<uint32_t> cluster{1, 0, 1};
    const std::vector<StoredValues> coefficients{StoredValues(std::vector<int8_t>{2, -3, 4})};
    for (const VectorUnit unit : vector_units()) {
        std::vector<float> out(6);
        weighted_sum({table, cluster, coefficients, 2}, 0, 3, out, unit);
        EXPECT_EQ(out, (std::vector<float>{3 + 2 * 4, 1 - 3 * 2, 3 + 4 * 4,  //
                                           7 + 2 * 8, 5 - 3 * 6, 7 + 4 * 8}));
    }
}

TEST(Combine, GivesTheSameBytesOnEveryVectorUnit) {
    for (const uint32_t num_planes : {1u, 3u, 4u, 5u, 16u, 17u, 25u, 33u, 75u}) {
        for (const uint32_t num_vertices : {1u, 3u, 64u, 203u}) {
            const Clustered c = random_clustered(num_vertices, num_planes, 18);
            BasisTable table;
            table.assign(c.rows, c.scales);
            for (const size_t used : {0u, 1u, 7u, 8u, 9u, 18u}) {
                const BasisSum combination{table, c.cluster, std::span(c.coefficients).first(used),
                                           19};
                std::vector<float> expected(size_t{num_planes} * num_vertices), out(expected);
                weighted_sum(combination, 0, num_vertices, expected, VectorUnit::plain);
                for (const VectorUnit unit : vector_units()) {
                    std::fill(out.begin(), out.end(), 9.0f);
                    // In two parts, as threads share them.
                    const size_t first_part = num_vertices / 3;
                    weighted_sum(combination, first_part, num_vertices - first_part, out, unit);
                    weighted_sum(combination, 0, first_part, out, unit);
                    ASSERT_EQ(bits(out), bits(expected))
                        << num_planes << " planes, " << num_vertices << " vertices, " << used
                        << " components, unit " << static_cast<int>(unit);
                }
            }
        }
    }
}

TEST(Combine, WritesNothingElse) {
    const Clustered c = random_clustered(203, 5, 2);
    BasisTable table;
    table.assign(c.rows, c.scales);
    for (const VectorUnit unit : vector_units()) {
        std::vector<float> out(size_t{5} * 203, 1000.0f);
        weighted_sum({table, c.cluster, c.coefficients, 3}, 10, 101, out, unit);
        for (size_t n = 0; n < out.size(); ++n) {
            EXPECT_EQ(out[n] == 1000.0f, n % 203 < 10 || n % 203 >= 111);
        }
    }
}

using CombineDeath = ::testing::Test;

TEST(CombineDeath, RefusesWhatDoesNotFit) {
    const Clustered c = random_clustered(10, 2, 2);
    BasisTable table;
    table.assign(c.rows, c.scales);
    std::vector<float> out(20);
    EXPECT_DEATH(weighted_sum({table, c.cluster, c.coefficients, 2}, 0, 10, out), "check failed");
    EXPECT_DEATH(weighted_sum({table, c.cluster, c.coefficients, 3}, 1, 10, out), "check failed");
    EXPECT_DEATH(
        weighted_sum({table, c.cluster, c.coefficients, 3}, 0, 10, std::span(out).first(19)),
        "check failed");
}

}  // namespace
}  // namespace paim
