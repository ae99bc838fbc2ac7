// Planes undone many at once, against one plane after the other from the mesh itself.
#include "paim/format/plane_undo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/format/plane_codec.h"

namespace paim {
namespace {

// The slow reference: of every vertex the neighbours before it, latest first.
std::vector<std::vector<uint32_t>> neighbours_before(const Topology& topology) {
    std::vector<std::set<uint32_t, std::greater<>>> all(topology.num_vertices);
    for (const Triangle& t : topology.triangles) {
        for (const uint32_t a : t) {
            for (const uint32_t b : t) {
                if (b < a) all[a].insert(b);
            }
        }
    }
    std::vector<std::vector<uint32_t>> latest;
    for (const auto& before : all) {
        latest.emplace_back(before.begin(), before.end());
        latest.back().resize(std::min<size_t>(before.size(), 4));
    }
    return latest;
}

int16_t predict(Prediction prediction, const std::vector<uint32_t>& parents, const int16_t* plane) {
    if (prediction == Prediction::none || parents.empty()) return 0;
    if (prediction == Prediction::latest) return plane[parents[0]];
    double sum = 0.0;
    for (const uint32_t parent : parents) sum += plane[parent];
    return static_cast<int16_t>(std::floor(sum / static_cast<double>(parents.size()) + 0.5));
}

// `residuals` become values; false if one is outside of the integers' symmetrical range.
template <typename Integer>
bool undo_slowly(Prediction prediction, const std::vector<std::vector<uint32_t>>& parents,
                 std::vector<int16_t>& residuals) {
    for (size_t v = 0; v < residuals.size(); ++v) {
        const int sum = residuals[v] + predict(prediction, parents[v], residuals.data());
        residuals[v] = static_cast<int16_t>(sum);
        if (std::abs(int{residuals[v]}) > std::numeric_limits<Integer>::max()) return false;
    }
    return true;
}

// A mesh without much order: up to seven neighbours before a vertex, far and near; a tenth of the
// vertices have no triangle.
Topology random_mesh(uint32_t num_vertices, RandomStream& random) {
    Topology topology{num_vertices, {}};
    for (uint32_t v = 2; v < num_vertices; ++v) {
        if (v % 10 == 0) continue;
        for (uint32_t j = 0; j < 1 + v % 3; ++j) {
            const uint32_t back = random.uniform() < 0.8 ? std::min(v, 20u) : v;
            topology.triangles.push_back(
                {v, v - 1 - static_cast<uint32_t>(random.uniform() * (back - 1)),
                 v - 1 - static_cast<uint32_t>(random.uniform() * (back - 1))});
        }
    }
    return topology;
}

// Values in range whose residuals reach `magnitude`, as far as they can.
struct Plane {
    PlaneHeader header;
    std::vector<int16_t> values;
    std::vector<uint8_t> bytes;
};

template <typename Integer>
Plane random_plane(Prediction prediction, Packing packing, int magnitude,
                   const std::vector<std::vector<uint32_t>>& parents, RandomStream& random) {
    constexpr int kMost = std::numeric_limits<Integer>::max();
    Plane plane{{prediction, packing, 0}, {}, {}};
    if (packing == Packing::packed) plane.header.magnitude = static_cast<uint8_t>(magnitude);
    plane.values.resize(parents.size());
    std::vector<int32_t> residuals(parents.size());
    for (size_t v = 0; v < parents.size(); ++v) {
        const int predicted = predict(prediction, parents[v], plane.values.data());
        int residual = static_cast<int>(std::lround((2.0 * random.uniform() - 1.0) * magnitude));
        if (std::abs(predicted + residual) > kMost) residual = -residual;
        if (std::abs(predicted + residual) > kMost) residual = 0;
        residuals[v] = residual;
        plane.values[v] = static_cast<int16_t>(predicted + residual);
    }
    plane.bytes.resize(packed_size(plane.header, residuals.size()));
    pack(plane.header, residuals, plane.bytes.data());
    return plane;
}

template <typename Integer>
void expect_values(const std::vector<Plane>& planes, const PlanePredictor& predictor,
                   size_t num_points) {
    std::vector<PackedPlane> packed;
    for (const Plane& plane : planes) packed.push_back({plane.header, plane.bytes.data()});
    std::vector<Integer> out(planes.size() * num_points + 1, 99);
    ScratchPool::Buffer rows;
    ASSERT_TRUE(undo_planes(packed, predictor, num_points, rows, out.data()));
    EXPECT_EQ(out.back(), 99);  // nothing is written past the end
    for (size_t j = 0; j < planes.size(); ++j) {
        for (size_t v = 0; v < num_points; ++v) {
            ASSERT_EQ(out[j * num_points + v], planes[j].values[v])
                << "plane " << j << " of " << planes.size() << ", point " << v << " of "
                << num_points;
        }
    }
}

constexpr Prediction kPredictions[] = {Prediction::none, Prediction::latest, Prediction::mean};

// Every prediction with every packing, in one lot.
template <typename Integer>
void expect_every_way(uint32_t num_points) {
    RandomStream random(stream_key(num_points, sizeof(Integer), 0));
    const Topology topology = random_mesh(num_points, random);
    const PlanePredictor predictor(topology);
    const auto parents = neighbours_before(topology);
    constexpr int kMost = std::numeric_limits<Integer>::max();
    std::vector<Plane> planes;
    for (const Prediction prediction : kPredictions) {
        const auto add = [&](Packing packing, int magnitude) {
            planes.push_back(
                random_plane<Integer>(prediction, packing, magnitude, parents, random));
        };
        add(Packing::nothing, 0);
        for (int magnitude = 1; magnitude <= kMaxPackedMagnitude; ++magnitude) {
            add(Packing::packed, magnitude);
        }
        add(Packing::bytes, 127);
        add(Packing::words, 2 * kMost > 32767 ? 32767 : 2 * kMost);
        add(Packing::words, 300);
    }
    expect_values<Integer>(planes, predictor, num_points);
}

TEST(PlaneUndo, IsTheSlowReferenceInEveryWay) {
    // Around blocks of 8, digits of 2, 3 and 5, and tiles of 240.
    for (const uint32_t num_points : {1u, 2u, 7u, 8u, 9u, 239u, 240u, 241u, 247u, 1003u}) {
        expect_every_way<int8_t>(num_points);
        expect_every_way<int16_t>(num_points);
    }
}

TEST(PlaneUndo, TakesAnyNumberOfPlanes) {
    RandomStream random(11);
    const Topology topology = random_mesh(301, random);
    const PlanePredictor predictor(topology);
    const auto parents = neighbours_before(topology);
    std::vector<Plane> means, mixed;
    for (uint32_t count = 1; count <= 70; ++count) {
        means.push_back(
            random_plane<int8_t>(Prediction::mean, Packing::bytes, 100, parents, random));
        mixed.push_back(random_plane<int8_t>(kPredictions[count * count % 3], Packing::packed,
                                             1 + static_cast<int>(count % 7), parents, random));
        expect_values<int8_t>(means, predictor, 301);
        expect_values<int8_t>(mixed, predictor, 301);
    }
}

// Means of the extremes, where a sum of 16 bits is not enough, by three parents and by four.
TEST(PlaneUndo, KeepsMeansOfExtremes) {
    const int16_t extremes[] = {-32767, -32766, -32765, -2, -1, 0, 1, 2, 3, 32765, 32766, 32767};
    for (uint32_t num_parents = 1; num_parents <= 4; ++num_parents) {
        Topology fan{num_parents + 1, {}};
        for (uint32_t v = 0; v < num_parents; ++v) fan.triangles.push_back({num_parents, v, v});
        const PlanePredictor predictor(fan);
        std::vector<Plane> planes;
        for (uint32_t choice = 0; choice < 12 * 12 * 12 * 12; choice += num_parents < 4 ? 1 : 5) {
            std::vector<int32_t> residuals;
            for (uint32_t j = 0, rest = choice; j < num_parents; ++j, rest /= 12) {
                residuals.push_back(extremes[rest % 12]);
            }
            residuals.push_back(0);
            Plane plane{{Prediction::mean, Packing::words, 0}, {}, {}};
            plane.values.assign(residuals.begin(), residuals.end());
            plane.bytes.resize(2 * residuals.size());
            pack(plane.header, residuals, plane.bytes.data());
            std::vector<uint32_t> all(num_parents);
            for (uint32_t j = 0; j < num_parents; ++j) all[j] = num_parents - 1 - j;
            plane.values.back() = predict(Prediction::mean, all, plane.values.data());
            planes.push_back(std::move(plane));
        }
        expect_values<int16_t>(planes, predictor, num_parents + 1);
    }
}

// Any bytes at all: the same planes, or both refuse.
TEST(PlaneUndo, JudgesAnyBytesAsTheSlowReferenceDoes) {
    RandomStream random(17);
    int num_refused = 0, num_taken = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const Topology topology = random_mesh(30, random);
        const PlanePredictor predictor(topology);
        const auto parents = neighbours_before(topology);
        PlaneHeader header{kPredictions[trial % 3],
                           trial % 4 == 0 ? Packing::packed : Packing::bytes, 0};
        if (header.packing == Packing::packed) header.magnitude = 1 + trial % 7;
        std::vector<uint8_t> bytes(packed_size(header, 30));
        // The size of most of them leaves both answers open.
        const double limit = header.packing == Packing::packed ? 256.0 : 110.0;
        for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(limit * random.uniform());
        std::vector<int16_t> expected(30 + kTilePadding);
        unpack_tile(header, bytes.data(), 30, 0, 30, expected.data());
        expected.resize(30);
        const bool good = undo_slowly<int8_t>(header.prediction, parents, expected);
        const PackedPlane plane{header, bytes.data()};
        std::vector<int8_t> out(30);
        ScratchPool::Buffer rows;
        ASSERT_EQ(undo_planes(std::span(&plane, 1), predictor, 30, rows, out.data()), good);
        if (good) {
            EXPECT_TRUE(std::equal(out.begin(), out.end(), expected.begin()));
        }
        ++(good ? num_taken : num_refused);
    }
    EXPECT_GT(num_refused, 20);
    EXPECT_GT(num_taken, 20);
}

TEST(ScratchPool, GivesEveryoneTheirOwnAndKeepsIt) {
    ScratchPool pool;
    const std::byte* first = nullptr;
    {
        ScratchPool::Lease one(pool), other(pool);
        first = (*one).rows.resize(100);
        EXPECT_NE(first, (*other).rows.resize(100));
        EXPECT_EQ(first, (*one).rows.resize(30));  // there is room
    }
    ScratchPool::Lease one(pool);
    EXPECT_EQ(first, (*one).rows.resize(100));
}

TEST(PlaneUndo, SharesWorkSpaceBetweenThreads) {
    RandomStream random(23);
    const Topology topology = random_mesh(500, random);
    const PlanePredictor predictor(topology);
    const auto parents = neighbours_before(topology);
    std::vector<std::vector<int8_t>> values(40);
    std::vector<std::vector<uint8_t>> frames;
    for (size_t j = 0; j < values.size(); ++j) {
        const size_t num_planes = 1 + j % 5;
        for (size_t plane = 0; plane < num_planes; ++plane) {
            const Plane some =
                random_plane<int8_t>(Prediction::mean, Packing::bytes, 20, parents, random);
            values[j].insert(values[j].end(), some.values.begin(), some.values.end());
        }
        frames.push_back(encode_planes(values[j], num_planes, predictor, Effort::fast));
    }
    ScratchPool pool;
    std::vector<std::optional<std::vector<int8_t>>> back(values.size());
    parallel_for(values.size(), 1, [&](size_t j, size_t) {
        std::vector<int8_t> out(values[j].size());
        if (decode_planes(frames[j], 1 + j % 5, predictor, pool, std::span(out))) back[j] = out;
    });
    for (size_t j = 0; j < values.size(); ++j) {
        ASSERT_TRUE(back[j].has_value());
        EXPECT_EQ(*back[j], values[j]);
    }
}

}  // namespace
}  // namespace paim
