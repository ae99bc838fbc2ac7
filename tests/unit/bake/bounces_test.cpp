// Sums of bounces against dense matrices, and rows of hits against single rays.
#include "compressor/bake/bounces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compressor/bake/ray_offset.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "poses/shapes.h"

namespace paim {
namespace {

constexpr size_t kOwn = 5, kStill = 3, kAll = kOwn + kStill;

// Random rows, terms and colours; two bands, three channels.
struct RandomScene {
    Eigen::MatrixXd rows[2];  // [own][all]
    BounceTerms still_terms;
    std::array<std::vector<float>, 2> direct;  // [C][V]
    BounceScene scene;

    RandomScene() {
        RandomStream random(5);
        const auto number = [&] { return static_cast<float>(random.uniform()); };
        for (auto& matrix : rows) {
            matrix = Eigen::MatrixXd::Zero(kOwn, kAll);
            for (auto& value : matrix.reshaped()) {
                if (random.uniform() < 0.6) value = static_cast<double>(0.2f * number());
            }
        }
        for (auto& half : direct) {
            half.resize(4 * kOwn);
            std::generate(half.begin(), half.end(), number);
        }
        for (int b = 0; b < 3; ++b) {
            BounceTerm& term = still_terms.emplace_back();
            for (auto& half : term) {
                half.resize(3 * 4 * kStill);
                std::generate(half.begin(), half.end(), number);
            }
        }
        scene.layout = {TransferKind::diffuse, 2, 3};
        scene.num_vertices = kOwn;
        scene.num_still_vertices = kStill;
        scene.albedo.values.resize(kOwn);
        for (Vec3f& value : scene.albedo.values) value = Vec3f(number(), number(), number());
        scene.still_albedo.values = {Vec3f(0.9f, 0.5f, 0.1f)};
        scene.still_terms = &still_terms;
        scene.make_row = [this](size_t v, size_t half, TransportRow& row) {
            row.clear();
            for (uint32_t u = 0; u < kAll; ++u) {
                const auto weight = static_cast<float>(rows[half](static_cast<int>(v), u));
                if (weight > 0.0f) row.push_back({u, weight});
            }
        };
    }
};

TEST(Bounces, AreTheDenseMatrixApplied) {
    const RandomScene random;
    for (const uint64_t max_bytes : {uint64_t{1} << 30, uint64_t{100}, uint64_t{0}}) {
        std::array<std::vector<float>, 2> halves = random.direct;
        const BounceTerms terms = add_bounces(random.scene, 3, halves, true, max_bytes);
        ASSERT_EQ(terms.size(), 3u);
        for (size_t half = 0; half < 2; ++half) {
            ASSERT_EQ(halves[half].size(), 3 * 4 * kOwn);
            for (size_t channel = 0; channel < 3; ++channel) {
                for (size_t i = 0; i < 4; ++i) {
                    Eigen::VectorXd term(kOwn);
                    for (size_t v = 0; v < kOwn; ++v) {
                        term[static_cast<int>(v)] = random.direct[half][i * kOwn + v];
                    }
                    Eigen::VectorXd total = term;
                    for (size_t b = 0; b < 3; ++b) {
                        Eigen::VectorXd light(kAll);
                        for (uint32_t v = 0; v < kOwn; ++v) {
                            light[v] =
                                random.scene.albedo.at(v)[static_cast<int>(channel)] * term[v];
                            EXPECT_NEAR(terms[b][half][(channel * kOwn + v) * 4 + i], term[v],
                                        1e-6);
                        }
                        for (uint32_t s = 0; s < kStill; ++s) {
                            light[kOwn + s] =
                                random.scene.still_albedo.at(s)[static_cast<int>(channel)] *
                                random.still_terms[b][half][(channel * kStill + s) * 4 + i];
                        }
                        term = random.rows[half] * light;
                        total += term;
                    }
                    for (size_t v = 0; v < kOwn; ++v) {
                        // Numbers of about 1, rounded to float a few times.
                        EXPECT_NEAR(halves[half][(channel * 4 + i) * kOwn + v],
                                    total[static_cast<int>(v)], 2e-6);
                    }
                }
            }
        }
    }
}

// Rows are kept until their bytes reach the limit; the others are made again for every bounce. Five
// vertices are less than one piece of work, so that the first rows are the ones that are kept.
TEST(Bounces, KeepAsManyRowsAsTheLimitAllows) {
    RandomScene random;
    size_t num_made = 0;
    random.scene.make_row = [&](size_t /*v*/, size_t /*half*/, TransportRow& row) {
        ++num_made;
        row.assign(3, {1, 0.1f});
    };
    constexpr uint64_t kRowBytes = 3 * sizeof(HitWeight);
    constexpr uint32_t kBounces = 3;
    constexpr size_t kRows = 2 * kOwn;
    for (const size_t num_kept : {size_t{0}, size_t{1}, size_t{4}, kRows}) {
        // The limit is reached by the last row that is kept, and may be passed by a part of it.
        for (const uint64_t past : {uint64_t{0}, kRowBytes - 1}) {
            if (num_kept == 0 && past > 0) continue;
            num_made = 0;
            std::array<std::vector<float>, 2> halves = random.direct;
            add_bounces(random.scene, kBounces, halves, false, num_kept * kRowBytes - past);
            EXPECT_EQ(num_made, num_kept + kBounces * (kRows - num_kept)) << num_kept;
        }
    }
}

TEST(Bounces, OfNoneLeaveTheTransfer) {
    RandomScene random;
    random.scene.layout.channels = 1;
    std::array<std::vector<float>, 2> halves = random.direct;
    EXPECT_TRUE(add_bounces(random.scene, 0, halves, true).empty());
    EXPECT_EQ(halves, random.direct);
}

TEST(Bounces, ColourIsWhatIsNotGrey) {
    EXPECT_FALSE(is_coloured({}));
    EXPECT_FALSE(is_coloured({{Vec3f::Constant(0.1f), Vec3f::Constant(0.7f)}}));
    EXPECT_TRUE(is_coloured({{Vec3f::Constant(0.1f), Vec3f(0.7f, 0.7f, 0.6f)}}));
    EXPECT_TRUE(is_coloured({{Vec3f(0.6f, 0.7f, 0.7f)}}));
}

TEST(HitRows, AreTheMeanOfWhatSingleRaysHit) {
    const auto sequence = poses::make_bowl_sequence(200);
    const Topology& topology = sequence->topology();
    const std::vector<Vec3f> positions = sequence->positions(0, 1);
    const RayScene scene(topology, positions);
    const auto sampler = make_sampler(SamplerKind::cosine, 64, HalfRelation::interleaved);
    const auto more = make_sampler(SamplerKind::cosine, 32, HalfRelation::interleaved);
    constexpr HalfKeys kKeys{3, 4};
    constexpr double kWeight = 2.0;  // of the rays of the second round
    for (const bool from_inside : {true, false}) {
        // From inside the bowl, and from below, where its backs are seen.
        const Vec3f origin = from_inside ? Vec3f(0.1f, -0.5f, 0.2f) : Vec3f(0.1f, -1.5f, 0.2f);
        const Vec3f normal = Vec3f(0.3f, from_inside ? -1.0f : 1.0f, 0.1f).normalized();
        HitTracer tracer(scene, topology, positions);
        tracer.trace(0, {origin, nullptr}, normal, *sampler, kKeys, 1);
        tracer.trace(0, {origin, nullptr}, normal, *more, kKeys, 1, kWeight);
        TransportRow row;
        tracer.end(row);

        std::vector<double> expected(positions.size(), 0.0);
        uint32_t num_hits = 0;
        for (const auto* batch : {sampler.get(), more.get()}) {
            RaySet rays;
            batch->generate(normal, kKeys, 1, rays);
            const double share = (batch == more.get() ? kWeight : 1.0) / 128;
            for (size_t j = 0; j < rays.num_rays; ++j) {
                const auto hit =
                    scene.intersect_first(origin, Vec3f(rays.x[j], rays.y[j], rays.z[j]));
                if (!hit) continue;
                ++num_hits;
                if (!from_inside) continue;
                const Triangle& t = topology.triangles[hit->triangle];
                const double u = hit->u, v = hit->v;
                expected[t[0]] += (1.0 - u - v) * share;
                expected[t[1]] += u * share;
                expected[t[2]] += v * share;
            }
        }
        EXPECT_GT(num_hits, 30u);
        EXPECT_EQ(tracer.num_back_hits(), from_inside ? 0 : num_hits);
        for (size_t j = 0; j + 1 < row.size(); ++j) EXPECT_LT(row[j].vertex, row[j + 1].vertex);
        for (const HitWeight& hit : row) {
            // A few hits' weights of at most 1/64, each rounded to float.
            EXPECT_NEAR(hit.weight, expected[hit.vertex], 1e-7);
            expected[hit.vertex] = 0.0;
        }
        EXPECT_EQ(*std::max_element(expected.begin(), expected.end()), 0.0);
    }
}

// A vertex at the bottom of a slit, whose rays start at the vertex itself: what its faces hide gives
// it its own light, and the rest meets a lid over half of the slit.
TEST(HitRows, OfSteepFacesMeetTheVertexItself) {
    const float t = 1e-3f;
    const Topology topology{
        10, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}, {7, 8, 9}}};
    const std::vector<Vec3f> positions{{0, 0, 0},  {1, t, 1},  {0, t, 1},  {-1, t, 1}, {-1, -t, 1},
                                       {0, -t, 1}, {1, -t, 1}, {0, -9, 2}, {0, 9, 2},  {40, 0, 2}};
    std::vector<Vec3f> normals(10, Vec3f::Zero());
    normals[0] = Vec3f(0, 0, 1);
    const RayStarts starts(topology, positions, normals);
    ASSERT_EQ(starts.num_fans(), 1u);
    const RayScene scene(topology, positions);
    const auto sampler = make_sampler(SamplerKind::cosine, 1 << 16, HalfRelation::interleaved);
    HitTracer tracer(scene, topology, positions);
    tracer.trace(0, starts[0], normals[0], *sampler, {3, 4}, 0);
    TransportRow row;
    tracer.end(row);
    EXPECT_EQ(tracer.num_back_hits(), 0u);
    RaySet rays;
    sampler->generate(normals[0], {3, 4}, 0, rays);
    std::vector<float> occluded(rays.num_rays);
    const uint32_t num_occluded = occluded_from(scene, starts[0], rays.x.data(), rays.y.data(),
                                                rays.z.data(), rays.num_rays, occluded.data());
    EXPECT_LT(num_occluded, rays.num_rays);
    double own = 0.0, lid = 0.0;
    for (const HitWeight& share : row) {
        EXPECT_TRUE(share.vertex == 0 || share.vertex >= 7) << share.vertex;
        (share.vertex == 0 ? own : lid) += static_cast<double>(share.weight);
    }
    EXPECT_GT(own, 0.9);
    EXPECT_GT(lid, 0.0);
    // Each ray weighs the same.
    EXPECT_NEAR(own + lid, static_cast<double>(num_occluded) / (1 << 16), 1e-5);
}

}  // namespace
}  // namespace paim
