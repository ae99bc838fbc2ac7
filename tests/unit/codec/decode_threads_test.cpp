// Decoded frames: the same bytes on any number of threads, and as the plain loops give them, of
// models of many pieces of work.
#include <gtest/gtest.h>

#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/codec/accumulate.h"
#include "paim/codec/low_rank.h"
#include "paim/codec/make_decoder.h"

namespace paim {
namespace {

constexpr uint32_t kVertices = 9001;

template <typename T>
StoredValues random_values(RandomStream& random, size_t count, double limit) {
    std::vector<T> values(count);
    for (T& value : values) value = static_cast<T>(limit * (2.0 * random.uniform() - 1.0));
    return values;
}

LowRankMatrix random_matrix(uint32_t num_points, uint32_t num_planes) {
    RandomStream random(num_planes);
    LowRankMatrix matrix;
    matrix.num_points = num_points;
    matrix.num_planes = num_planes;
    matrix.num_poses = 3;
    matrix.num_components = 5;
    matrix.precision = Precision::i16;
    for (uint32_t j = 0; j < num_planes; ++j) matrix.steps.push_back(0.01f * float(j + 1));
    matrix.mean = random_values<int16_t>(random, matrix.num_rows(), 30000.0);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        matrix.components.push_back(k < 2
                                        ? random_values<int16_t>(random, matrix.num_rows(), 30000.0)
                                        : random_values<int8_t>(random, matrix.num_rows(), 127.0));
    }
    for (int j = 0; j < 15; ++j) matrix.weights.push_back(float(random.uniform()) - 0.5f);
    return matrix;
}

Model random_model(bool clustered) {
    Model model;
    model.topology.num_vertices = kVertices;
    model.layout = {TransferKind::diffuse, 3, 1};
    model.geometry = random_matrix(kVertices, 3);
    if (!clustered) {
        model.transfer = random_matrix(kVertices, 9);
        return model;
    }
    RandomStream random(4);
    VertexClusters& clusters = model.clusters;
    clusters.num_clusters = 7;
    clusters.num_components = 4;
    for (uint32_t v = 0; v < kVertices; ++v) {
        clusters.cluster.push_back(static_cast<uint32_t>(6.999 * random.uniform()));
    }
    for (uint32_t j = 0; j < 4; ++j) {
        clusters.coefficients.push_back(random_values<int8_t>(random, kVertices, 127.0));
    }
    clusters.scales.assign(clusters.num_rows(), 0.5f);
    model.transfer = random_matrix(clusters.num_rows(), 9);
    return model;
}

TEST(DecodeThreads, GiveTheSameBytes) {
    for (const bool clustered : {false, true}) {
        const Model model = random_model(clustered);
        const std::unique_ptr<Decoder> decoder = make_decoder(model);
        DecodedPose one, some;
        {
            const ThreadLimit limit(1);
            decoder->decode(1.3, {}, one);
        }
        for (const int num_threads : {2, 3, 7}) {
            const ThreadLimit limit(num_threads);
            decoder->decode(1.3, {}, some);
            EXPECT_EQ(some.positions, one.positions);
            EXPECT_EQ(some.transfer, one.transfer);
        }
    }
}

TEST(DecodeThreads, GiveTheBytesOfThePlainLoop) {
    const Model model = random_model(false);
    DecodedPose pose;
    make_decoder(model)->decode(1.3, {}, pose);
    const LowRankMatrix& matrix = model.transfer;
    std::vector<float> weights, plane(kVertices);
    interpolate_weights(matrix, 1.3, weights);
    for (uint32_t j = 0; j < matrix.num_planes; ++j) {
        accumulate(matrix.mean, matrix.components, weights, matrix.step(j), size_t{j} * kVertices,
                   plane, VectorUnit::plain);
        EXPECT_TRUE(std::equal(plane.begin(), plane.end(),
                               pose.transfer.begin() + ptrdiff_t{j} * kVertices));
    }
}

// Frames of one model into one pose: the work space is that of the first.
TEST(DecodeThreads, KeepTheWorkSpace) {
    const Model model = random_model(true);
    const std::unique_ptr<Decoder> decoder = make_decoder(model);
    DecodedPose pose;
    decoder->decode(0.0, {}, pose);
    const std::vector<const float*> before{pose.positions.data(), pose.transfer.data(),
                                           pose.basis_rows.data(), pose.row_table.values.data()};
    decoder->decode(1.0, {.bands = 2}, pose);
    decoder->decode(2.0, {}, pose);
    EXPECT_EQ(before,
              (std::vector<const float*>{pose.positions.data(), pose.transfer.data(),
                                         pose.basis_rows.data(), pose.row_table.values.data()}));
}

}  // namespace
}  // namespace paim
