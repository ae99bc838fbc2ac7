// Integers at vertices: predictions by hand, round trips at every packing, damage.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "paim/base/seed.h"
#include "paim/format/pack/index_decoder.h"
#include "paim/format/pack/index_encoder.h"
#include "paim/format/pack/plane_decoder.h"
#include "paim/format/pack/plane_encoder.h"
#include "paim/format/pack/plane_packing.h"
#include "paim/format/pack/plane_residuals.h"
#include "paim/format/pack/plane_unpacking.h"
#include "paim/format/pack/zstd_decoder.h"
#include "paim/format/pack/zstd_encoder.h"
#include "paim/mesh/cache_order.h"
#include "tests/grid_surface.h"

namespace paim {
namespace {

template <typename Integer>
std::vector<Integer> subtract(const PlanePredictor& predictor, Prediction prediction,
                              const std::vector<Integer>& values) {
    std::vector<Integer> residuals(values.size());
    subtract_prediction(predictor, prediction, std::span<const Integer>(values),
                        std::span(residuals));
    return residuals;
}

TEST(PlanePredictor, TakesNeighboursBeforeTheVertex) {
    // Vertex 4 of a 3 × 3 grid: 1, 2, 3 are its neighbours before it (0 is not: the diagonal is
    // from
    // 1 to 3).
    const PlanePredictor predictor(make_grid(3));
    const std::vector<int16_t> values{100, 10, 20, 34, 7, 0, 0, 0, 0};
    const auto residuals = subtract(predictor, Prediction::mean, values);
    EXPECT_EQ(residuals[0], 100);       // nobody before it
    EXPECT_EQ(residuals[1], 10 - 100);  // 0
    EXPECT_EQ(residuals[4], 7 - 25);    // (2 · 34 + 20 + 10) / 4, ties up
    EXPECT_EQ(residuals[3], 34 - 55);   // 0 and 1: 110 / 2
    EXPECT_EQ(subtract(predictor, Prediction::none, values), values);
}

TEST(PlanePredictor, CompletesParallelograms) {
    const PlanePredictor predictor(make_grid(3));
    const std::vector<int16_t> values{100, 10, 20, 34, 7, 9, 0, 0, 0};
    const auto residuals = subtract(predictor, Prediction::parallelograms, values);
    EXPECT_EQ(residuals[0], 100);                  // nobody
    EXPECT_EQ(residuals[1], 10 - 100);             // 0, twice
    EXPECT_EQ(residuals[2], 20 - 10);              // 1, twice
    EXPECT_EQ(residuals[3], 34 - 55);              // 1 and 0 share no triangle but its own
    EXPECT_EQ(residuals[4], 7 - (34 + 10 - 100));  // across the edge 1 3 from 0
    EXPECT_EQ(residuals[5], 9 - (7 + 20 - 10));    // across the edge 2 4 from 1
}

// A linear function is what a parallelogram says, wherever there is one.
TEST(PlanePredictor, ParallelogramsAreRightOnSlopes) {
    const PlanePredictor predictor(make_grid(9));
    std::vector<int16_t> values;
    for (int v = 0; v < 81; ++v) values.push_back(static_cast<int16_t>(5 * (v % 9) - 3 * (v / 9)));
    const auto residuals = subtract(predictor, Prediction::parallelograms, values);
    for (int v = 9; v < 81; ++v) {
        if (v % 9 == 0) continue;
        EXPECT_EQ(residuals[static_cast<size_t>(v)], 0) << v;
    }
}

TEST(PlanePredictor, RoundsHalvesUpAndWrapsAround) {
    const Topology triangle{3, {{0, 1, 2}}};
    const PlanePredictor predictor(triangle);
    for (const int16_t sum : {-3, -2, -1, 0, 1, 2, 3}) {
        const auto residuals =
            subtract(predictor, Prediction::mean, std::vector<int16_t>{sum, 0, 0});
        EXPECT_EQ(residuals[2], -static_cast<int32_t>(std::floor(sum / 2.0 + 0.5))) << sum;
    }
    const std::vector<int16_t> extremes{32767, -32767, 32767};
    const std::vector<int8_t> small_extremes{127, -127, 127};
    for (const Prediction prediction : {Prediction::mean, Prediction::parallelograms}) {
        auto residuals = subtract(predictor, prediction, extremes);
        add_prediction(predictor, prediction, std::span(residuals));
        EXPECT_EQ(residuals, extremes);
        auto small_residuals = subtract(predictor, prediction, small_extremes);
        add_prediction(predictor, prediction, std::span(small_residuals));
        EXPECT_EQ(small_residuals, small_extremes);
    }
}

TEST(PlanePredictor, KeepsTheFourLatestOfMany) {
    Topology fan{9, {}};
    for (uint32_t v = 0; v < 8; ++v) fan.triangles.push_back({8, v, (v + 1) % 8});
    const PlanePredictor predictor(fan);
    const std::vector<int16_t> values{1000, 1000, 1000, 1000, 4, 5, 6, 9, 0};
    EXPECT_EQ(subtract(predictor, Prediction::mean, values)[8], -6);
}

TEST(PlanePredictor, ChainsFollowTheOneBefore) {
    const PlanePredictor predictor = PlanePredictor::chain(4);
    for (const Prediction prediction : {Prediction::mean, Prediction::parallelograms}) {
        EXPECT_EQ(subtract(predictor, prediction, std::vector<int16_t>{7, 9, 4, 4}),
                  (std::vector<int16_t>{7, 2, -5, 0}));
    }
}

// Packed symbols, the first one in the highest place, and escapes: gaps, zigzag.
TEST(PlanePacking, IsWhatTheDocumentsSay) {
    std::vector<int16_t> residuals{1, -1, 0, 0, 1, 0, 0, 3};
    PackedPlane plane = pack(Prediction::none, 1, std::span<const int16_t>(residuals));
    EXPECT_EQ(plane.symbols, (std::vector<uint8_t>{2 * 81 + 0 + 9 + 3 + 2, 81 + 27 + 18 + 3 + 1}));
    EXPECT_EQ(plane.gaps, (std::vector<uint8_t>{7}));
    EXPECT_EQ(plane.lows, (std::vector<uint8_t>{4}));
    EXPECT_FALSE(plane.header.wide);
    residuals.assign(600, 0);
    residuals[0] = -1;
    residuals[256] = 2;    // 255 between: no escape of 0
    residuals[599] = 300;  // 342 between: one of 0 after 255, and 86 more
    plane = pack(Prediction::none, 0, std::span<const int16_t>(residuals));
    EXPECT_TRUE(plane.symbols.empty());
    EXPECT_EQ(plane.gaps, (std::vector<uint8_t>{0, 255, 255, 86}));
    EXPECT_EQ(plane.lows, (std::vector<uint8_t>{1, 4, 0, 600 & 255}));
    EXPECT_EQ(plane.highs, (std::vector<uint8_t>{0, 0, 0, 2}));
    plane = pack(Prediction::none, kByteSymbols, std::span<const int16_t>(residuals).last(1));
    EXPECT_EQ(plane.symbols, (std::vector<uint8_t>{254}));
    EXPECT_EQ(plane.lows, (std::vector<uint8_t>{(2 * (300 - 127)) & 255}));
}

// The bytes that docs/algorithms/quantisation.md draws.
TEST(PlanePacking, PacksTheExampleOfTheDocuments) {
    using Bytes = std::vector<uint8_t>;
    const std::vector<int16_t> narrow{1, 0, -1, 0, 6, -1};
    PackedPlane plane = pack(Prediction::none, 1, std::span<const int16_t>(narrow));
    EXPECT_EQ(plane.symbols, (Bytes{0xc2, 0x28}));
    EXPECT_EQ(plane.gaps, (Bytes{0x04}));
    EXPECT_EQ(plane.lows, (Bytes{0x0a}));
    EXPECT_FALSE(plane.header.wide);
    const std::vector<int16_t> wide{302, -2, 0, -699, 0, -1};
    plane = pack(Prediction::none, 2, std::span<const int16_t>(wide));
    EXPECT_EQ(plane.symbols, (Bytes{0x66, 0x0b}));
    EXPECT_EQ(plane.gaps, (Bytes{0x00, 0x02}));
    EXPECT_EQ(plane.lows, (Bytes{0x58, 0x71}));
    EXPECT_EQ(plane.highs, (Bytes{0x02, 0x05}));
}

// Planes whose magnitudes go from 0 to `limit`, each another way.
template <typename Integer>
std::vector<Integer> some_planes(uint32_t n, const std::vector<double>& limits, uint64_t seed) {
    RandomStream random(seed);
    std::vector<Integer> values;
    for (const double limit : limits) {
        for (uint32_t v = 0; v < n * n; ++v) {
            const double smooth = std::sin(0.3 * (v % n)) * std::cos(0.2 * (v / n));
            values.push_back(static_cast<Integer>(
                std::lround(limit * (0.7 * smooth + 0.3 * (2.0 * random.uniform() - 1.0)))));
        }
    }
    return values;
}

template <typename Integer>
void expect_round_trip(const std::vector<double>& limits) {
    const Topology topology = make_grid(20);
    for (const PlanePredictor& predictor : {PlanePredictor(topology), PlanePredictor()}) {
        const std::vector<Integer> values = some_planes<Integer>(20, limits, 5);
        for (const Effort effort : {Effort::fast, Effort::small}) {
            const auto bytes = encode_planes(values, limits.size(), predictor, effort);
            std::vector<Integer> back(values.size());
            ASSERT_TRUE(decode_planes(bytes, limits.size(), predictor, std::span(back)));
            EXPECT_EQ(back, values);
        }
    }
}

TEST(PlaneCodec, RoundTripsEveryPacking) {
    expect_round_trip<int8_t>({0, 1, 1.4, 2, 3, 5, 7, 8, 60, 126, 0});
    expect_round_trip<int16_t>({0, 1, 127, 300, 3000, 32766, 2});
    expect_round_trip<int16_t>({32766});
    expect_round_trip<int8_t>({0});
}

TEST(PlaneCodec, TakesNoPoints) {
    const auto bytes = encode_planes(std::vector<int8_t>{}, 3, PlanePredictor());
    std::vector<int8_t> none;
    EXPECT_TRUE(decode_planes(bytes, 3, PlanePredictor(), std::span(none)));
    EXPECT_FALSE(decode_planes(bytes, 2, PlanePredictor(), std::span(none)));
}

TEST(PlaneCodec, PredictionMakesSmoothPlanesSmall) {
    const Topology topology = make_grid(64);
    std::vector<int8_t> values;
    for (uint32_t v = 0; v < 64 * 64; ++v) {
        values.push_back(static_cast<int8_t>(
            std::lround(90.0 * std::sin(0.15 * (v % 64)) * std::cos(0.1 * (v / 64)))));
    }
    const size_t with = encode_planes(values, 1, PlanePredictor(topology)).size();
    const size_t without = encode_planes(values, 1, PlanePredictor()).size();
    EXPECT_LT(with * 2, without);
}

TEST(PlaneCodec, CostsFarLessThanABitWhereHardlyAnythingIs) {
    std::vector<int8_t> values(100000, 0);
    RandomStream random(3);
    for (int j = 0; j < 1000; ++j) {
        values[static_cast<size_t>(random.uniform() * 1e5)] = random.uniform() < 0.5 ? -1 : 1;
    }
    // Entropy of 1 % of signs: 0.09 bits a value.
    EXPECT_LT(encode_planes(values, 1, PlanePredictor()).size() * 8, 0.2 * 100000);
}

TEST(PlaneCodec, AnswersDamageWithFalseOrOtherNumbers) {
    const Topology topology = make_grid(8);
    const PlanePredictor predictor(topology);
    const std::vector<double> limits{0, 1, 4, 100};
    const auto bytes = encode_planes(some_planes<int8_t>(8, limits, 9), 4, predictor);
    std::vector<int8_t> out(4 * 64);
    for (size_t place = 0; place < bytes.size(); ++place) {
        for (int bit = 0; bit < 8; ++bit) {
            auto damaged = bytes;
            damaged[place] = static_cast<uint8_t>(damaged[place] ^ (1 << bit));
            decode_planes(damaged, 4, predictor, std::span(out));
        }
    }
    for (size_t length = 0; length < bytes.size(); ++length) {
        EXPECT_FALSE(decode_planes(std::span(bytes).first(length), 4, predictor, std::span(out)));
    }
    EXPECT_FALSE(
        decode_planes(bytes, 4, PlanePredictor(), std::span(out)));  // no mesh to predict on
    // A frame of too much, and one of too little.
    const auto big = zstd_compress(std::vector<uint8_t>(100000, 0));
    EXPECT_FALSE(decode_planes(big, 4, predictor, std::span(out)));
    const auto small = zstd_compress(std::vector<uint8_t>(7, 0));
    EXPECT_FALSE(decode_planes(small, 4, predictor, std::span(out)));
    const auto zero = zstd_compress(std::vector<uint8_t>(6 * 4, 0));
    EXPECT_TRUE(decode_planes(zero, 4, predictor, std::span(out)));
    // One frame, neither two nor one that is passed over.
    auto twice = zero;
    const auto empty = zstd_compress({});
    twice.insert(twice.end(), empty.begin(), empty.end());
    EXPECT_FALSE(decode_planes(twice, 4, predictor, std::span(out)));
    auto passed_over = zero;
    for (const uint8_t byte : {0x50, 0x2a, 0x4d, 0x18, 0, 0, 0, 0}) passed_over.push_back(byte);
    EXPECT_FALSE(decode_planes(passed_over, 4, predictor, std::span(out)));
    EXPECT_FALSE(zstd_decompress(std::span(passed_over).last(8), {}));
    // −128 is no value, although eight bits hold it: symbol −127 and an escape of −1.
    std::vector<uint8_t> lowest(6 + 64, 0);
    lowest[1] = kByteSymbols;
    lowest[6] = 253;  // −127
    EXPECT_TRUE(decode_planes(zstd_compress(lowest), 1, predictor, std::span(out).first(64)));
    lowest[2] = 1;  // escape
    lowest.insert(lowest.end(), {0, 1});
    for (const uint8_t prediction : {0, 1, 2}) {
        lowest[0] = prediction;
        EXPECT_FALSE(decode_planes(zstd_compress(lowest), 1, predictor, std::span(out).first(64)));
    }
}

// Every header that is none, and escapes that do not fit.
TEST(PlaneCodec, RefusesOtherHeaders) {
    const PlanePredictor predictor(make_grid(8));
    std::vector<int8_t> out(64);
    const auto decodes = [&](std::vector<uint8_t> header, std::vector<uint8_t> rest) {
        header.insert(header.end(), rest.begin(), rest.end());
        return decode_planes(zstd_compress(header), 1, predictor, std::span(out));
    };
    EXPECT_TRUE(decodes({0, 0, 1, 0, 0, 0}, {63, 2}));
    EXPECT_EQ(out[63], 1);
    EXPECT_TRUE(decodes({1, 0, 1, 0, 0, 0}, {63, 2}));
    EXPECT_FALSE(decodes({0, 0, 1, 0, 0, 0}, {64, 2}));  // past the end
    EXPECT_FALSE(decodes({2, 0, 1, 0, 0, 0}, {64, 2}));
    EXPECT_FALSE(decodes({0, 0, 1, 0, 0, 0}, {63, 2, 0}));  // a byte too many
    EXPECT_FALSE(decodes({0, 0, 1, 0, 0, 0}, {63}));        // one too few
    EXPECT_FALSE(decodes({0, 0, 0, 0, 0, 1}, {}));
    EXPECT_FALSE(decodes({0, 0, 65, 0, 0, 0}, std::vector<uint8_t>(130, 0)));
    EXPECT_TRUE(decodes({4, 0, 1, 0, 0, 0}, {63, 2, 0}));  // wide
    EXPECT_FALSE(decodes({3, 0, 0, 0, 0, 0}, {}));
    EXPECT_FALSE(decodes({8, 0, 0, 0, 0, 0}, {}));
    for (int magnitude = 1; magnitude < 256; ++magnitude) {
        const auto a = static_cast<uint8_t>(magnitude);
        const bool is = std::find(kMagnitudes.begin(), kMagnitudes.end(), a) != kMagnitudes.end();
        if (is) {
            EXPECT_TRUE(decodes({0, a, 0, 0, 0, 0}, std::vector<uint8_t>(symbol_bytes(a, 64))));
            continue;
        }
        for (const size_t size : {0, 13, 22, 32, 64}) {
            EXPECT_FALSE(decodes({0, a, 0, 0, 0, 0}, std::vector<uint8_t>(size)));
        }
    }
}

TEST(IndexCodec, KeepsTrianglesUpToTurning) {
    Topology topology = make_grid(30);
    topology.triangles.push_back({5, 5, 9});      // degenerate
    topology.triangles.push_back({899, 0, 400});  // far apart
    const CacheOrder order = cache_order(topology);
    const auto bytes = encode_triangles(order.topology);
    std::vector<Triangle> back(order.topology.triangles.size());
    ASSERT_TRUE(decode_triangles(bytes, back));
    for (size_t t = 0; t < back.size(); ++t) {
        const Triangle& expected = order.topology.triangles[t];
        const auto turned = [&](uint32_t by) {
            return Triangle{expected[by % 3], expected[(by + 1) % 3], expected[(by + 2) % 3]};
        };
        EXPECT_TRUE(back[t] == turned(0) || back[t] == turned(1) || back[t] == turned(2)) << t;
    }
    EXPECT_LT(bytes.size(), 3 * back.size() / 2);  // 12 bytes a triangle as they are
    std::vector<Triangle> more(back.size() + 1);
    EXPECT_FALSE(decode_triangles(bytes, more));
    EXPECT_FALSE(decode_triangles(std::span(bytes).first(bytes.size() / 2), back));
    std::vector<Triangle> none;
    EXPECT_TRUE(decode_triangles(encode_triangles({3, {}}), none));
}

TEST(CacheOrder, IsAPermutationThatKeepsTheMesh) {
    Topology topology = make_grid(12);
    topology.num_vertices += 3;  // without triangles
    const CacheOrder order = cache_order(topology);
    ASSERT_EQ(order.old_vertex.size(), 147u);
    std::vector<int> seen(147, 0);
    for (const uint32_t old : order.old_vertex) ++seen[old];
    EXPECT_EQ(seen, std::vector<int>(147, 1));
    EXPECT_EQ(order.old_vertex[146], 146u);
    const auto canonical = [](Triangle t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    std::vector<Triangle> old_triangles, new_triangles;
    for (const Triangle& t : topology.triangles) old_triangles.push_back(canonical(t));
    for (const Triangle& t : order.topology.triangles) {
        new_triangles.push_back(
            canonical({order.old_vertex[t[0]], order.old_vertex[t[1]], order.old_vertex[t[2]]}));
    }
    std::sort(old_triangles.begin(), old_triangles.end());
    std::sort(new_triangles.begin(), new_triangles.end());
    EXPECT_EQ(old_triangles, new_triangles);
    EXPECT_TRUE(cache_order({4, {}}).topology.triangles.empty());
}

// Two planes of six values, laid out as in docs/format.md: packed symbols, then the gaps, low bytes
// and high bytes of the escapes of both planes. An escape may add to any symbol, as the one of −699
// does.
TEST(PlaneCodec, ReadsAFrameWrittenByHand) {
    const std::vector<uint8_t> contents{
        0x00, 1,    1, 0, 0, 0,  // no prediction, symbols up to 1, one escape
        0x04, 2,    2, 0, 0, 0,  // escapes are wide, symbols up to 2, two of them
        194,  40,                // 1 0 −1 0 1, −1: 2 1 0 1 2 and 0 1 1 1 1 in base 3
        102,  86,                // 2 −2 0, 1 0 −1: 4 0 2 and 3 2 1 in base 5
        4,                       // value 4
        0,    2,                 // values 0 and 3
        10,                      // 5 more than its symbol
        0x58, 0x77,              // 300 more, 700 less: zigzag 600 and 1399
        0x02, 0x05};
    std::vector<int16_t> values(12);
    ASSERT_TRUE(decode_planes<int16_t>(zstd_compress(contents), 2, PlanePredictor(), values));
    EXPECT_EQ(values, (std::vector<int16_t>{1, 0, -1, 0, 6, -1, 302, -2, 0, -699, 0, -1}));
}

}  // namespace
}  // namespace paim
