// Light before the coefficients of vertices, against the definition, and against decoding and
// shading.
#include "paim/codec/cpca/cpca_player.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/codec/mesh_decoder.h"
#include "paim/shade/shade.h"
#include "tests/example_asset.h"

namespace paim {
namespace {

LightCoefficients make_light(uint32_t bands) {
    RandomStream random(11);
    LightCoefficients light{static_cast<int>(bands), {}};
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    for (uint32_t i = 0; i < bands * bands; ++i) {
        const float red = number(), green = number(), blue = number();
        light.values.emplace_back(red, green, blue);
    }
    return light;
}

const CpcaTransfer& cpca_of(const CodedMesh& mesh) {
    return *mesh.transfer.as<CpcaTransfer>();
}

// The light product of a row in pose p, by definition; `magnitude` of what is summed, which
// rounding is relative to.
struct Sum {
    double value = 0.0;
    double magnitude = 0.0;
};

Sum row_product(const CodedMesh& mesh, uint32_t row, uint32_t channel, uint32_t p, uint32_t bands,
                uint32_t num_components, const LightCoefficients& light) {
    const CpcaTransfer& transfer = cpca_of(mesh);
    const LowRank& matrix = transfer.matrix;
    Sum sum;
    for (uint32_t i = 0; i < bands * bands; ++i) {
        const uint32_t plane = mesh.layout.plane(mesh.layout.channels == 3 ? channel : 0, i);
        const size_t r = size_t{plane} * matrix.num_points + row;
        const double factor = static_cast<double>(transfer.clusters.scales[row]) *
                              matrix.step(plane) * light.values[i][channel];
        const auto add = [&](double value) {
            sum.value += factor * value;
            sum.magnitude += std::abs(factor * value);
        };
        add(matrix.mean[r]);
        for (uint32_t k = 0; k < num_components; ++k) {
            add(static_cast<double>(matrix.components[k][r]) *
                matrix.weights[size_t{k} * matrix.num_poses + p]);
        }
    }
    return sum;
}

// Float sums of at most 100 terms, a few roundings each.
constexpr double kRounding = 200.0 / (1 << 24);

TEST(CpcaPlayer, IsTheProductOfEveryRowWithTheLight) {
    const LightCoefficients light = make_light(3);
    for (const uint32_t channels : {1u, 3u}) {
        for (const bool integers : {false, true}) {
            const CodedMesh mesh = make_clustered_example(3, channels, 2, integers).moving();
            CpcaPlayer player(cpca_of(mesh), mesh.layout);
            std::vector<Vec3f> products;
            player.basis_radiance(2.0, {}, light, products);
            ASSERT_EQ(products.size(), 6u);
            for (uint32_t row = 0; row < 6; ++row) {
                for (uint32_t channel = 0; channel < 3; ++channel) {
                    const Sum expected = row_product(mesh, row, channel, 2, 3, 3, light);
                    EXPECT_NEAR(products[row][channel], expected.value,
                                kRounding * expected.magnitude);
                }
            }
        }
    }
}

TEST(CpcaPlayer, KeepsWithinLimits) {
    const CodedMesh mesh = make_clustered_example(3, 3, 2, true).moving();
    CpcaPlayer player(cpca_of(mesh), mesh.layout);
    std::vector<Vec3f> products;
    const LightCoefficients light = make_light(3);
    const DecodeLimits limits{.transfer_components = 1, .bands = 2, .vertex_components = 1};
    player.basis_radiance(3.0, limits, light, products);
    for (uint32_t row = 0; row < 6; ++row) {
        const Sum expected = row_product(mesh, row, 1, 3, 2, 1, light);
        EXPECT_NEAR(products[row][1], row % 3 == 2 ? 0.0 : expected.value,
                    kRounding * expected.magnitude);
    }
}

// Under a light of one band, one cluster and one component: (2 + 3 · (-4)) · 5.
TEST(CpcaPlayer, ShadesAMeanAndItsComponent) {
    const CpcaTransfer transfer(LowRank::still(1, std::vector<int8_t>{4, 6}, {0.5f}),
                                {1, 1, {0, 0}, {std::vector<int8_t>{-4, 1}}, {1.0f, 1.0f}});
    std::vector<Vec3f> products, radiance(2);
    CpcaPlayer(transfer, {TransferKind::diffuse, 1, 1})
        .basis_radiance(0.0, {}, {1, {Vec3f(5, 10, 20)}}, products);
    EXPECT_EQ(products, (std::vector<Vec3f>{Vec3f(10, 20, 40), Vec3f(15, 30, 60)}));
    const ClusterShading shading(transfer.clusters);
    shading.shade(products, 1, {{Vec3f(1, 1, 0.5f)}}, radiance);
    EXPECT_EQ(radiance, (std::vector<Vec3f>{Vec3f(-50, -100, -100), Vec3f(25, 50, 50)}));
    shading.shade(products, 0, {{Vec3f(1, 1, 1), Vec3f(0, 0, 1)}}, radiance);
    EXPECT_EQ(radiance, (std::vector<Vec3f>{Vec3f(10, 20, 40), Vec3f(0, 0, 40)}));
}

// Several hundred clusters: more rows than a block, more vertices than a piece of work.
CodedMesh make_large(uint32_t channels, bool integers) {
    CodedMesh mesh = make_clustered_example(2, channels, 3, integers).moving();
    RandomStream random(12);
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    constexpr uint32_t kVertices = 3000, kClusters = 300;
    mesh.topology.num_vertices = kVertices;
    VertexClusters& clusters = mesh.transfer.as<CpcaTransfer>()->clusters;
    clusters.num_clusters = kClusters;
    clusters.cluster.resize(kVertices);
    for (uint32_t& c : clusters.cluster) c = static_cast<uint32_t>(random.uniform() * kClusters);
    for (StoredValues& coefficients : clusters.coefficients) {
        if (integers) {
            std::vector<int8_t> values(kVertices);
            for (int8_t& q : values) q = static_cast<int8_t>(127.0f * number());
            coefficients = values;
        } else {
            std::vector<float> values(kVertices);
            std::generate(values.begin(), values.end(), number);
            coefficients = values;
        }
    }
    clusters.scales.resize(clusters.num_rows());
    std::generate(clusters.scales.begin(), clusters.scales.end(), number);
    mesh.positions.num_points = kVertices;
    mesh.positions.mean = std::vector<float>(mesh.positions.num_rows());
    for (StoredValues& c : mesh.positions.components) c = mesh.positions.mean;
    LowRank& matrix = mesh.transfer->matrix;
    matrix.num_points = clusters.num_rows();
    const auto fill = [&](StoredValues& out) {
        std::vector<float> rows(matrix.num_rows());
        std::generate(rows.begin(), rows.end(), number);
        if (!integers) {
            out = rows;
            return;
        }
        std::vector<int16_t> steps(rows.size());
        for (size_t j = 0; j < rows.size(); ++j) steps[j] = static_cast<int16_t>(900 * rows[j]);
        out = steps;
    };
    fill(matrix.mean);
    for (StoredValues& component : matrix.components) fill(component);
    return mesh;
}

TEST(CpcaPlayer, EqualsDecodingAndShading) {
    for (const uint32_t channels : {1u, 3u}) {
        for (const bool integers : {false, true}) {
            CodedMesh mesh = make_large(channels, integers);
            mesh.albedo.values.assign(mesh.topology.num_vertices, Vec3f(0.5f, 0.25f, 0.75f));
            mesh.albedo.values[7] = Vec3f(1, 0, 0);
            MeshDecoder decoder(mesh);
            CpcaPlayer player(cpca_of(mesh), mesh.layout);
            std::vector<Vec3f> radiance, expected;
            DecodedPose pose;
            for (const DecodeLimits limits :
                 {DecodeLimits{}, DecodeLimits{.transfer_components = 1, .bands = 1},
                  DecodeLimits{.transfer_components = 0, .vertex_components = 2}}) {
                for (const uint32_t light_bands : {1u, 2u, 3u}) {
                    const LightCoefficients light = make_light(light_bands);
                    decoder.decode(1.6, limits, pose);
                    shade(pose.layout, pose.transfer, mesh.albedo, light, expected);
                    player.light(1.6, limits, light, mesh.albedo, radiance);
                    ASSERT_EQ(radiance.size(), expected.size());
                    float largest = 0.0f, off = 0.0f;
                    for (size_t v = 0; v < expected.size(); ++v) {
                        largest = std::max(largest, expected[v].cwiseAbs().maxCoeff());
                        off = std::max(off, (radiance[v] - expected[v]).cwiseAbs().maxCoeff());
                    }
                    // Sums of 4 · 4 · 4 terms, none larger than the largest sum of 3000.
                    EXPECT_GT(largest, 0.0f);
                    EXPECT_LE(off, 64.0f * 3.0f / (1 << 24) * largest);
                }
            }
        }
    }
}

TEST(CpcaPlayer, GivesTheSameBytesInAnyOrderOfFrames) {
    const CodedMesh mesh = make_large(3, true);
    const LightCoefficients light = make_light(2);
    CpcaPlayer reused(cpca_of(mesh), mesh.layout);
    std::vector<Vec3f> products, radiance, again;
    reused.light(3.5, {.vertex_components = 1}, make_light(1), mesh.albedo, radiance);
    for (const double time : {4.0, 0.0, 2.25}) {
        reused.basis_radiance(time, {}, light, products);
        reused.light(time, {}, light, mesh.albedo, radiance);
        std::vector<Vec3f> fresh;
        CpcaPlayer(cpca_of(mesh), mesh.layout).basis_radiance(time, {}, light, fresh);
        EXPECT_EQ(products, fresh);
        CpcaPlayer(cpca_of(mesh), mesh.layout).light(time, {}, light, mesh.albedo, again);
        EXPECT_EQ(radiance, again);
    }
}

TEST(CpcaPlayerDeathTest, RefusesBasesWithoutClusters) {
    const CodedMesh mesh = make_example_asset().moving();
    const CpcaTransfer transfer(mesh.transfer->matrix, {});
    EXPECT_DEATH(CpcaPlayer(transfer, mesh.layout), "clusters");
}

}  // namespace
}  // namespace paim
