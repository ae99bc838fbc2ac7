// Integers at vertices: predictions by hand, round trips at every packing, damage.
#include "paim/format/plane_codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "paim/base/seed.h"
#include "paim/format/index_codec.h"
#include "paim/mesh/locality.h"

namespace paim {
namespace {

// A grid of n × n vertices, row by row.
Topology grid(uint32_t n) {
    Topology topology{n * n, {}};
    for (uint32_t y = 0; y + 1 < n; ++y) {
        for (uint32_t x = 0; x + 1 < n; ++x) {
            const uint32_t a = y * n + x;
            topology.triangles.push_back({a, a + 1, a + n});
            topology.triangles.push_back({a + 1, a + n + 1, a + n});
        }
    }
    return topology;
}

TEST(PlanePredictor, TakesNeighboursBeforeTheVertex) {
    // Vertex 4 of a 3 × 3 grid: 1, 2, 3 are its neighbours before it (0 is not: the diagonal is from
    // 1 to 3).
    const PlanePredictor predictor(grid(3));
    const std::vector<int32_t> values{100, 10, 20, 33, 7, 0, 0, 0, 0};
    std::vector<int32_t> residuals(9);
    predictor.subtract(Prediction::mean, values, residuals);
    EXPECT_EQ(residuals[0], 100);       // nobody before it
    EXPECT_EQ(residuals[1], 10 - 100);  // 0
    EXPECT_EQ(residuals[4], 7 - 21);    // (10 + 20 + 33) / 3
    EXPECT_EQ(residuals[3], 33 - 55);   // 0 and 1: 110 / 2
    predictor.subtract(Prediction::latest, values, residuals);
    EXPECT_EQ(residuals[4], 7 - 33);
    predictor.subtract(Prediction::none, values, residuals);
    EXPECT_EQ(residuals, values);
}

TEST(PlanePredictor, RoundsHalvesUpAndWrapsAround) {
    const Topology triangle{3, {{0, 1, 2}}};
    const PlanePredictor predictor(triangle);
    std::vector<int32_t> residuals(3);
    for (const int32_t sum : {-3, -2, -1, 0, 1, 2, 3}) {
        predictor.subtract(Prediction::mean, std::vector<int32_t>{sum, 0, 0}, residuals);
        EXPECT_EQ(residuals[2], -static_cast<int32_t>(std::floor(sum / 2.0 + 0.5))) << sum;
    }
    const std::vector<int32_t> extremes{32767, -32767, 32767};
    for (const Prediction prediction : {Prediction::mean, Prediction::latest}) {
        predictor.subtract(prediction, extremes, residuals);
        for (const int32_t r : residuals) EXPECT_EQ(r, static_cast<int16_t>(r));
        predictor.add(prediction, residuals);
        EXPECT_EQ(residuals, extremes);
    }
}

TEST(PlanePredictor, KeepsTheFourLatestOfMany) {
    Topology fan{9, {}};
    for (uint32_t v = 0; v < 8; ++v) fan.triangles.push_back({8, v, (v + 1) % 8});
    const PlanePredictor predictor(fan);
    std::vector<int32_t> values{1000, 1000, 1000, 1000, 4, 5, 6, 9, 0}, residuals(9);
    predictor.subtract(Prediction::mean, values, residuals);
    EXPECT_EQ(residuals[8], -6);
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
    const Topology topology = grid(20);
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
    const Topology topology = grid(64);
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
    const Topology topology = grid(8);
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
    const auto zero = zstd_compress(std::vector<uint8_t>(8, 0));
    EXPECT_TRUE(decode_planes(zero, 4, predictor, std::span(out)));
    // −128 is no value, although eight bits hold it: residuals 127 and −255 + 256 … of zigzag bytes.
    std::vector<uint8_t> lowest(2 + 64, 0);
    lowest[0] = 2 << 2;
    lowest[2] = 255;  // −128
    EXPECT_FALSE(decode_planes(zstd_compress(lowest), 1, predictor, std::span(out).first(64)));
}

TEST(IndexCodec, KeepsTrianglesUpToTurning) {
    Topology topology = grid(30);
    topology.triangles.push_back({5, 5, 9});      // degenerate
    topology.triangles.push_back({899, 0, 400});  // far apart
    const LocalOrder order = local_order(topology);
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

TEST(LocalOrder, IsAPermutationThatKeepsTheMesh) {
    Topology topology = grid(12);
    topology.num_vertices += 3;  // without triangles
    const LocalOrder order = local_order(topology);
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
    EXPECT_TRUE(local_order({4, {}}).topology.triangles.empty());
}

}  // namespace
}  // namespace paim
