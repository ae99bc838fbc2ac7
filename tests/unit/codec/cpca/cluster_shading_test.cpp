// The radiance of vertices of clusters: every vector unit of this machine against the definition, bit
// for bit.
#include "paim/codec/cpca/cluster_shading.h"

#include <gtest/gtest.h>

#include <vector>

#include "paim/base/seed.h"
#include "tests/float_bits.h"

namespace paim {
namespace {

// Coefficients are i16, i8 and float in turns. Most vertices are of one cluster, which is longer than
// a piece of work; of two clusters there are none.
VertexClusters some_clusters(uint32_t num_vertices, uint32_t num_components) {
    RandomStream random(num_vertices);
    VertexClusters clusters;
    clusters.num_clusters = 9;
    clusters.num_components = num_components;
    for (uint32_t v = 0; v < num_vertices; ++v) {
        const auto other = static_cast<uint32_t>(6.999 * random.uniform());
        clusters.cluster.push_back(random.uniform() < 0.6 ? 3 : other);
    }
    for (uint32_t j = 0; j < num_components; ++j) {
        const auto fill = [&]<typename T>(std::vector<T> values, double limit) {
            for (T& value : values) value = static_cast<T>(limit * (2.0 * random.uniform() - 1.0));
            clusters.coefficients.emplace_back(std::move(values));
        };
        if (j % 3 == 0) fill(std::vector<int16_t>(num_vertices), 32768.0);
        if (j % 3 == 1) fill(std::vector<int8_t>(num_vertices), 128.0);
        if (j % 3 == 2) fill(std::vector<float>(num_vertices), 2.0);
    }
    return clusters;
}

std::vector<Vec3f> random_colours(size_t count) {
    RandomStream random(count);
    std::vector<Vec3f> colours(count);
    for (Vec3f& colour : colours) {
        for (float& value : colour) value = static_cast<float>(2.0 * random.uniform() - 1.0);
    }
    return colours;
}

std::vector<Vec3f> by_definition(const VertexClusters& clusters, const std::vector<Vec3f>& rows,
                                 uint32_t num_components, const Albedo& albedo) {
    std::vector<Vec3f> radiance;
    for (uint32_t v = 0; v < clusters.cluster.size(); ++v) {
        const size_t first = size_t{clusters.cluster[v]} * clusters.rows_per_cluster();
        Vec3f sum = rows[first];
        for (uint32_t j = 0; j < num_components; ++j) {
            sum += clusters.coefficients[j][v] * rows[first + 1 + j];
        }
        radiance.push_back(sum.cwiseProduct(albedo.at(v)));
    }
    return radiance;
}

std::vector<float> floats(const std::vector<Vec3f>& colours) {
    std::vector<float> result;
    for (const Vec3f& colour : colours) result.insert(result.end(), colour.begin(), colour.end());
    return result;
}

TEST(ClusterShading, GivesTheSameBytesOnEveryVectorUnit) {
    for (const uint32_t num_vertices : {0u, 1u, 15u, 16u, 1203u, 2500u}) {
        const VertexClusters clusters = some_clusters(num_vertices, 18);
        const ClusterShading shading(clusters);
        const std::vector<Vec3f> rows = random_colours(clusters.num_rows());
        for (const Albedo& albedo :
             {Albedo{{Vec3f(0.5f, 0.3f, 0.9f)}}, Albedo{random_colours(num_vertices)}}) {
            if (albedo.values.empty()) continue;
            for (const uint32_t used : {0u, 1u, 7u, 8u, 9u, 18u, 19u}) {
                const std::vector<Vec3f> expected =
                    by_definition(clusters, rows, std::min(used, 18u), albedo);
                for (const VectorUnit unit : vector_units()) {
                    std::vector<Vec3f> radiance(num_vertices);
                    shading.shade(rows, used, albedo, radiance, unit);
                    ASSERT_EQ(bits(floats(radiance)), bits(floats(expected)))
                        << num_vertices << " vertices, " << used << " components, unit "
                        << static_cast<int>(unit);
                }
            }
        }
    }
}

TEST(ClusterShadingDeathTest, RefusesOtherBases) {
    const VertexClusters clusters = some_clusters(20, 2);
    std::vector<Vec3f> radiance(20);
    const std::vector<Vec3f> rows = random_colours(clusters.num_rows() - 1);
    EXPECT_DEATH(ClusterShading(clusters).shade(rows, 2, {}, radiance), "check failed");
}

}  // namespace
}  // namespace paim
