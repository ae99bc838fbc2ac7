// Sums of components: every vector unit of this machine against the plain loop, bit for bit.
#include "paim/codec/accumulate.h"

#include <gtest/gtest.h>

#include <vector>

#include "paim/base/seed.h"
#include "tests/float_bits.h"

namespace paim {
namespace {

constexpr size_t kSize = 10007;

StoredValues random_values(Precision precision, uint64_t seed) {
    RandomStream random(seed);
    const auto fill = [&]<typename T>(std::vector<T> values, double limit) {
        for (T& value : values) value = static_cast<T>(limit * (2.0 * random.uniform() - 1.0));
        return StoredValues(std::move(values));
    };
    if (precision == Precision::i8) return fill(std::vector<int8_t>(kSize), 128.0);
    if (precision == Precision::i16) return fill(std::vector<int16_t>(kSize), 32768.0);
    return fill(std::vector<float>(kSize), 3.0);
}

// The precision of component k, as encoders mix them and as they do not.
struct Mix {
    const char* name;
    Precision mean;
    Precision (*component)(size_t k);
};

const Mix kMixes[] = {
    {"f32", Precision::f32, [](size_t) { return Precision::f32; }},
    {"i16", Precision::i16, [](size_t) { return Precision::i16; }},
    {"i8", Precision::i8, [](size_t) { return Precision::i8; }},
    {"i16, then i8", Precision::i16,
     [](size_t k) { return k < 3 ? Precision::i16 : Precision::i8; }},
    {"in turns", Precision::f32,
     [](size_t k) {
         return k % 3 == 0 ? Precision::i8 : (k % 3 == 1 ? Precision::f32 : Precision::i16);
     }},
};

// As bits, so that 0 and −0 are told apart.
TEST(Accumulate, IsTheSumItStandsFor) {
    const StoredValues mean(std::vector<int16_t>{100, -200, 300});
    const std::vector<StoredValues> components{StoredValues(std::vector<int8_t>{1, 2, -128}),
                                               StoredValues(std::vector<float>{0.5f, 0.25f, 8.0f})};
    const std::vector<float> weights{2.0f, 4.0f};
    for (const VectorUnit unit : vector_units()) {
        std::vector<float> out(2);
        accumulate(mean, components, weights, 0.5f, 1, out, unit);
        EXPECT_EQ(out, (std::vector<float>{0.5f * (-200 + 4 + 1), 0.5f * (300 - 256 + 32)}));
    }
}

TEST(Accumulate, GivesTheSameBytesOnEveryVectorUnit) {
    for (const Mix& mix : kMixes) {
        const StoredValues mean = random_values(mix.mean, 1);
        std::vector<StoredValues> components;
        std::vector<float> weights;
        RandomStream random(2);
        for (size_t k = 0; k <= 17; ++k) {
            for (const size_t first : {0u, 1u, 7u, 64u}) {
                for (const size_t size :
                     {0u, 1u, 3u, 8u, 15u, 17u, 63u, 64u, 65u, 129u, 1000u, 9943u}) {
                    for (const float step : {1.0f, 0.37f}) {
                        std::vector<float> expected(size), out(size, 9.0f);
                        accumulate(mean, components, weights, step, first, expected,
                                   VectorUnit::plain);
                        for (const VectorUnit unit : vector_units()) {
                            accumulate(mean, components, weights, step, first, out, unit);
                            ASSERT_EQ(bits(out), bits(expected))
                                << mix.name << ", " << k << " components, " << size << " from "
                                << first << ", unit " << static_cast<int>(unit);
                        }
                    }
                }
            }
            components.push_back(random_values(mix.component(k), 3 + k));
            weights.push_back(static_cast<float>(random.uniform()) - 0.5f);
        }
    }
}

// Memory before and after the values asked for stays as it is.
TEST(Accumulate, WritesNothingElse) {
    const StoredValues mean = random_values(Precision::i8, 1);
    const std::vector<StoredValues> components(9, random_values(Precision::i8, 2));
    const std::vector<float> weights(9, 1.5f);
    for (const VectorUnit unit : vector_units()) {
        std::vector<float> out(300, 7.0f);
        accumulate(mean, components, weights, 2.0f, 5, std::span(out).subspan(40, 201), unit);
        for (size_t n = 0; n < out.size(); ++n) EXPECT_EQ(out[n] == 7.0f, n < 40 || n >= 241);
    }
}

TEST(VectorUnits, BeginWithTheReferenceAndEndWithTheBest) {
    ASSERT_GE(vector_units().size(), 2u);
    EXPECT_EQ(vector_units()[0], VectorUnit::plain);
    EXPECT_EQ(vector_units()[1], VectorUnit::portable);
    EXPECT_EQ(vector_units().back(), best_vector_unit());
}

using AccumulateDeath = ::testing::Test;

TEST(AccumulateDeath, RefusesWhatDoesNotFit) {
    const StoredValues mean(std::vector<float>(4));
    const std::vector<StoredValues> components{StoredValues(std::vector<float>(4))};
    const std::vector<StoredValues> short_components{StoredValues(std::vector<float>(3))};
    const std::vector<float> weights(2);
    std::vector<float> out(3);
    const std::span<const float> one_weight = std::span(weights).first(1);
    EXPECT_DEATH(accumulate(mean, components, weights, 1.0f, 0, out), "check failed");
    EXPECT_DEATH(accumulate(mean, components, one_weight, 1.0f, 2, out), "check failed");
    EXPECT_DEATH(accumulate(mean, short_components, one_weight, 1.0f, 0, out), "check failed");
}

}  // namespace
}  // namespace paim
