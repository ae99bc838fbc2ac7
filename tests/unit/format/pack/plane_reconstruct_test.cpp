// Planes undone many at once, against one plane after the other from the mesh itself.
#include "paim/format/pack/plane_reconstruct.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/format/pack/plane_decoder.h"
#include "paim/format/pack/plane_encoder.h"
#include "paim/format/pack/plane_packing.h"
#include "paim/format/pack/plane_residuals.h"
#include "paim/format/pack/plane_unpacking.h"

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

// The slow reference, in the integers' arithmetic: of every vertex what it is predicted to be.
template <typename Integer>
class SlowPredictor {
  public:
    explicit SlowPredictor(const Topology& topology) : before_(neighbours_before(topology)) {}

    Integer predict(Prediction prediction, size_t v, const Integer* plane) const {
        const std::vector<uint32_t>& parents = before_[v];
        if (prediction == Prediction::none || parents.empty()) return 0;
        if (prediction == Prediction::mean) {
            double sum = 0.0;
            for (const uint32_t parent : parents) sum += plane[parent];
            auto count = static_cast<double>(parents.size());
            if (parents.size() == 3) {
                sum += plane[parents[0]];
                count = 4.0;
            }
            return static_cast<Integer>(std::floor(sum / count + 0.5));
        }
        std::vector<Integer> two;
        for (size_t i = 0; i < parents.size(); ++i) {
            for (size_t j = i + 1; j < parents.size(); ++j) {
                const uint32_t a = parents[i], b = parents[j];
                if (!precedes(b, a)) continue;
                for (const uint32_t c : before_[a]) {
                    if (c == b || !(c > b ? precedes(b, c) : precedes(c, b))) continue;
                    two.push_back(static_cast<Integer>(plane[a] + plane[b] - plane[c]));
                    break;
                }
            }
        }
        if (two.empty()) two = {plane[parents[0]], plane[parents[parents.size() > 1]]};
        if (two.size() == 1) two.push_back(two[0]);
        return static_cast<Integer>(std::floor((two[0] + two[1]) / 2.0 + 0.5));
    }

    size_t num_points() const { return before_.size(); }

  private:
    bool precedes(uint32_t parent, uint32_t child) const {
        return std::find(before_[child].begin(), before_[child].end(), parent) !=
               before_[child].end();
    }

    std::vector<std::vector<uint32_t>> before_;
};

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
template <typename Integer>
struct Plane {
    std::vector<Integer> values;
    PackedPlane packed;

    PlaneSource<Integer> source(Integer* out) const {
        return {packed.header,      packed.symbols.data(), packed.gaps.data(),
                packed.lows.data(), packed.highs.data(),   out};
    }
};

template <typename Integer>
Plane<Integer> random_plane(Prediction prediction, uint8_t largest_symbol, double magnitude,
                            const SlowPredictor<Integer>& slow, RandomStream& random) {
    constexpr auto kLowest = std::numeric_limits<Integer>::min();
    Plane<Integer> plane;
    plane.values.resize(slow.num_points());
    std::vector<Integer> residuals(slow.num_points());
    for (size_t v = 0; v < residuals.size(); ++v) {
        const Integer predicted = slow.predict(prediction, v, plane.values.data());
        // Most are small, so that gaps are long.
        const double size = random.uniform() < 0.7 ? 0.3 : magnitude;
        auto residual = static_cast<Integer>(std::lround((2.0 * random.uniform() - 1.0) * size));
        if (static_cast<Integer>(predicted + residual) == kLowest) ++residual;
        residuals[v] = residual;
        plane.values[v] = static_cast<Integer>(predicted + residual);
    }
    plane.packed = pack(prediction, largest_symbol, std::span<const Integer>(residuals));
    return plane;
}

template <typename Integer>
void expect_values(const std::vector<Plane<Integer>>& planes, const PlanePredictor& predictor,
                   size_t num_points) {
    std::vector<PlaneSource<Integer>> sources;
    std::vector<Integer> out(planes.size() * num_points + 1, 99);
    for (size_t j = 0; j < planes.size(); ++j) {
        sources.push_back(planes[j].source(out.data() + j * num_points));
    }
    Buffer rows;
    ASSERT_TRUE(reconstruct_planes(std::span(sources), predictor, num_points, rows));
    EXPECT_EQ(out.back(), 99);  // nothing is written past the end
    for (size_t j = 0; j < planes.size(); ++j) {
        for (size_t v = 0; v < num_points; ++v) {
            ASSERT_EQ(out[j * num_points + v], planes[j].values[v])
                << "plane " << j << " of " << planes.size() << ", point " << v << " of "
                << num_points;
        }
    }
}

constexpr Prediction kPredictions[] = {Prediction::none, Prediction::mean,
                                       Prediction::parallelograms};

// Every prediction with every packing, in one lot.
template <typename Integer>
void expect_every_way(uint32_t num_points) {
    RandomStream random(stream_key(num_points, sizeof(Integer), 0));
    const Topology topology = random_mesh(num_points, random);
    const PlanePredictor predictor(topology);
    const SlowPredictor<Integer> slow(topology);
    std::vector<Plane<Integer>> planes;
    for (const Prediction prediction : kPredictions) {
        for (const uint8_t largest_symbol : kMagnitudes) {
            for (const double magnitude :
                 {0.0, 1.0, 4.0, 120.0, 0.99 * std::numeric_limits<Integer>::max()}) {
                planes.push_back(
                    random_plane<Integer>(prediction, largest_symbol, magnitude, slow, random));
            }
        }
    }
    expect_values(planes, predictor, num_points);
}

TEST(PlaneUndo, IsTheSlowReference) {
    for (const uint32_t num_points :
         {1u, 2u, 7u, 8u, 9u, 15u, 16u, 17u, 239u, 240u, 241u, 256u, 479u, 1000u}) {
        expect_every_way<int8_t>(num_points);
        expect_every_way<int16_t>(num_points);
    }
}

// PlanePredictor undoes one plane, and must agree.
TEST(PlaneUndo, IsWhatThePredictorAdds) {
    RandomStream random(5);
    const Topology topology = random_mesh(400, random);
    const PlanePredictor predictor(topology);
    const SlowPredictor<int8_t> slow(topology);
    for (const Prediction prediction : kPredictions) {
        const auto plane = random_plane<int8_t>(prediction, 2, 100.0, slow, random);
        std::vector<int8_t> values(400);
        subtract_prediction(predictor, prediction, std::span<const int8_t>(plane.values),
                            std::span(values));
        add_prediction(predictor, prediction, std::span(values));
        EXPECT_EQ(values, plane.values);
        expect_values<int8_t>({plane}, predictor, 400);
    }
}

// Any number of planes, of which any number are means: vectors of lanes that are pure and mixed.
template <typename Integer>
void expect_any_number(uint32_t most) {
    RandomStream random(11);
    const Topology topology = random_mesh(301, random);
    const PlanePredictor predictor(topology);
    const SlowPredictor<Integer> slow(topology);
    std::vector<Plane<Integer>> means, slopes;
    for (uint32_t j = 0; j < most; ++j) {
        const uint8_t largest_symbol = kMagnitudes[j * j % kMagnitudes.size()];
        means.push_back(random_plane(Prediction::mean, largest_symbol, 100.0, slow, random));
        slopes.push_back(
            random_plane(Prediction::parallelograms, largest_symbol, 100.0, slow, random));
    }
    for (uint32_t count = 1; count <= most; ++count) {
        for (const uint32_t num_means : {0u, 1u, count / 3, count / 2, count - 1, count}) {
            std::vector<Plane<Integer>> planes(means.begin(), means.begin() + num_means);
            planes.insert(planes.end(), slopes.begin(), slopes.begin() + (count - num_means));
            expect_values(planes, predictor, 301);
        }
    }
}

TEST(PlaneUndo, TakesAnyNumberOfPlanes) {
    expect_any_number<int8_t>(70);
    expect_any_number<int16_t>(35);
}

// Means of all small numbers and of extremes, by one to four parents: as floors of exact sums.
template <typename Integer>
void expect_exact_means() {
    constexpr int kMax = std::numeric_limits<Integer>::max();
    const int choices[] = {-kMax, 1 - kMax, 2 - kMax, -2, -1, 0, 1, 2, 3, kMax - 2, kMax - 1, kMax};
    for (uint32_t num_parents = 1; num_parents <= 4; ++num_parents) {
        Topology fan{num_parents + 1, {}};
        for (uint32_t v = 0; v < num_parents; ++v) fan.triangles.push_back({num_parents, v, v});
        const PlanePredictor predictor(fan);
        const SlowPredictor<Integer> slow(fan);
        std::vector<Plane<Integer>> planes;
        for (uint32_t choice = 0; choice < 12 * 12 * 12 * 12; choice += num_parents < 4 ? 1 : 5) {
            std::vector<Integer> residuals;
            for (uint32_t j = 0, rest = choice; j < num_parents; ++j, rest /= 12) {
                residuals.push_back(static_cast<Integer>(choices[rest % 12]));
            }
            Plane<Integer> plane;
            plane.values = residuals;
            plane.values.push_back(slow.predict(Prediction::mean, num_parents, residuals.data()));
            residuals.push_back(0);
            plane.packed =
                pack(Prediction::mean, kByteSymbols, std::span<const Integer>(residuals));
            planes.push_back(std::move(plane));
        }
        expect_values(planes, predictor, num_parents + 1);
    }
}

TEST(PlaneUndo, KeepsMeansOfExtremes) {
    expect_exact_means<int8_t>();
    expect_exact_means<int16_t>();
}

// Any bytes at all: the same planes, or both refuse.
TEST(PlaneUndo, JudgesAnyBytesAsTheSlowReferenceDoes) {
    RandomStream random(17);
    int num_refused = 0, num_taken = 0;
    for (int trial = 0; trial < 600; ++trial) {
        const Topology topology = random_mesh(30, random);
        const PlanePredictor predictor(topology);
        const SlowPredictor<int8_t> slow(topology);
        const auto below = [&](double limit) {
            return static_cast<uint8_t>(limit * random.uniform());
        };
        PlaneHeader header{kPredictions[trial % 3], below(2.0) == 1,
                           kMagnitudes[below(kMagnitudes.size())], below(8.0)};
        std::vector<uint8_t> symbols(symbol_bytes(header.magnitude, 30));
        for (uint8_t& byte : symbols) byte = below(256.0);
        std::vector<uint8_t> gaps(header.num_escapes), lows(gaps), highs(gaps);
        for (uint8_t& gap : gaps) gap = below(8.0);
        for (uint8_t& low : lows) low = below(256.0);
        for (uint8_t& high : highs) high = below(256.0);

        std::vector<int8_t> values(30 + kTilePadding);
        unpack_symbols(header.magnitude, symbols.data(), 0, 30, values.data());
        bool good = true;
        size_t place = 0;
        for (size_t j = 0; j < gaps.size() && good; ++j, ++place) {
            place += gaps[j];
            good = place < 30;
            const int code = lows[j] + (header.wide ? 256 * highs[j] : 0);
            const int added = code % 2 == 0 ? code / 2 : -(code + 1) / 2;
            if (good) values[place] = static_cast<int8_t>(values[place] + added);
        }
        for (size_t v = 0; v < 30 && good; ++v) {
            const int8_t predicted = slow.predict(header.prediction, v, values.data());
            values[v] = static_cast<int8_t>(values[v] + predicted);
        }
        values.resize(30);
        good = good && std::find(values.begin(), values.end(), -128) == values.end();

        std::vector<int8_t> out(30);
        PlaneSource<int8_t> plane{header,      symbols.data(), gaps.data(),
                                  lows.data(), highs.data(),   out.data()};
        Buffer rows;
        ASSERT_EQ(reconstruct_planes(std::span(&plane, 1), predictor, 30, rows), good) << trial;
        if (good) {
            EXPECT_EQ(out, values);
        }
        ++(good ? num_taken : num_refused);
    }
    EXPECT_GT(num_refused, 100);
    EXPECT_GT(num_taken, 100);
}

TEST(WorkspacePool, GivesEveryoneTheirOwnAndKeepsIt) {
    WorkspacePool pool;
    const std::byte* first = nullptr;
    {
        WorkspacePool::Lease one(pool), other(pool);
        first = (*one).rows.resize(100);
        EXPECT_NE(first, (*other).rows.resize(100));
        EXPECT_EQ(first, (*one).rows.resize(30));  // there is room
    }
    WorkspacePool::Lease one(pool);
    EXPECT_EQ(first, (*one).rows.resize(100));
}

TEST(PlaneUndo, SharesWorkspacesBetweenThreads) {
    RandomStream random(23);
    const Topology topology = random_mesh(500, random);
    const PlanePredictor predictor(topology);
    const SlowPredictor<int8_t> slow(topology);
    std::vector<std::vector<int8_t>> values(40);
    std::vector<std::vector<uint8_t>> frames;
    for (size_t j = 0; j < values.size(); ++j) {
        const size_t num_planes = 1 + j % 5;
        for (size_t plane = 0; plane < num_planes; ++plane) {
            const auto some = random_plane<int8_t>(kPredictions[1 + j % 2], 0, 20.0, slow, random);
            values[j].insert(values[j].end(), some.values.begin(), some.values.end());
        }
        frames.push_back(encode_planes(values[j], num_planes, predictor, Effort::fast));
    }
    WorkspacePool pool;
    std::vector<std::vector<int8_t>> back(values.size());
    parallel_for(values.size(), 1, [&](size_t j, size_t) {
        WorkspacePool::Lease workspace(pool);
        // Two sections at once.
        std::vector<int8_t> out(values[j].size()), again(out);
        const StoredPlanes<int8_t> two[] = {{frames[j], 1 + j % 5, out},
                                            {frames[j], 1 + j % 5, again}};
        if (decode_planes(std::span<const StoredPlanes<int8_t>>(two), predictor, *workspace) &&
            out == again) {
            back[j] = out;
        }
    });
    EXPECT_EQ(back, values);
}

}  // namespace
}  // namespace paim
