// Clustered transfer against the sum it stands for; planes over all poses against poses one by one.
#include "paim/codec/cpca/cpca_transfer.h"

#include <gtest/gtest.h>

#include <vector>

#include "paim/codec/component_planes.h"
#include "paim/codec/mesh_decoder.h"
#include "tests/example_asset.h"

namespace paim {
namespace {

// Row of the transfer's matrix in pose p, by definition.
double basis_value(const LowRank& matrix, uint32_t plane, uint32_t row, uint32_t p,
                   uint32_t num_components) {
    const size_t r = size_t{plane} * matrix.num_points + row;
    double value = matrix.mean[r];
    for (uint32_t k = 0; k < num_components; ++k) {
        value += static_cast<double>(matrix.components[k][r]) *
                 matrix.weights[size_t{k} * matrix.num_poses + p];
    }
    return value * matrix.step(plane);
}

// The same of a vertex.
double vertex_value(const CodedMesh& mesh, uint32_t plane, uint32_t v, uint32_t p,
                    const DecodeLimits& limits) {
    const LowRank& matrix = mesh.transfer->matrix;
    const VertexClusters& clusters = mesh.transfer.as<CpcaTransfer>()->clusters;
    const uint32_t used = std::min(limits.transfer_components, matrix.num_components);
    const uint32_t first = clusters.cluster[v] * clusters.rows_per_cluster();
    double value = clusters.scales[first] * basis_value(matrix, plane, first, p, used);
    for (uint32_t j = 0; j < std::min(limits.vertex_components, clusters.num_components); ++j) {
        const uint32_t row = first + 1 + j;
        value += static_cast<double>(clusters.coefficients[j][v]) * clusters.scales[row] *
                 basis_value(matrix, plane, row, p, used);
    }
    return value;
}

TEST(CpcaTransfer, IsTheSumItStandsFor) {
    for (const bool integers : {false, true}) {
        const Asset asset = make_clustered_example(3, 3, 2, integers);
        MeshDecoder decoder(asset.moving());
        for (const DecodeLimits limits :
             {DecodeLimits{}, DecodeLimits{.transfer_components = 1, .vertex_components = 1},
              DecodeLimits{.vertex_components = 0}}) {
            DecodedPose pose;
            decoder.decode(2.0, limits, pose);
            ASSERT_EQ(pose.transfer.size(), 27u * 4);
            for (uint32_t plane = 0; plane < 27; ++plane) {
                for (uint32_t v = 0; v < 4; ++v) {
                    const double expected = vertex_value(asset.moving(), plane, v, 2, limits);
                    // A dozen float roundings of sums of a few magnitudes.
                    EXPECT_NEAR(pose.transfer[plane * 4 + v], expected,
                                1e-5 * (integers ? 10000.0 : 1.0));
                }
            }
        }
    }
}

TEST(CpcaTransfer, KeepsTheLayoutWithinLimits) {
    const Asset asset = make_clustered_example(3, 3);
    DecodedPose pose;
    MeshDecoder(asset.moving()).decode(1.0, {.bands = 2}, pose);
    EXPECT_EQ(pose.layout.in_bands, 2u);
    ASSERT_EQ(pose.transfer.size(), 3u * 4 * 4);
    // Plane 1 · 4 + 3 of the limited layout is plane 1 · 9 + 3 of the mesh's.
    EXPECT_NEAR(pose.transfer[(4 + 3) * 4 + 2], vertex_value(asset.moving(), 9 + 3, 2, 1, {}),
                1e-5);
}

TEST(MeshDecoder, GivesTheSameBytesInAnyOrderOfFrames) {
    for (const Asset& asset :
         {quantise_example(make_example_asset(3, 3)), make_clustered_example(3, 3, 2, true)}) {
        MeshDecoder decoder(asset.moving());
        std::vector<DecodedPose> sequence(asset.num_poses());
        DecodedPose reused;
        for (uint32_t p = 0; p < asset.num_poses(); ++p) {
            decoder.decode(p, {}, reused);
            sequence[p] = reused;
        }
        for (const uint32_t p : {3u, 0u, 4u, 1u, 1u, 2u}) {
            decoder.decode(p, {}, reused);
            EXPECT_EQ(reused.positions, sequence[p].positions);
            EXPECT_EQ(reused.transfer, sequence[p].transfer);
            DecodedPose fresh;
            MeshDecoder(asset.moving()).decode(p, {}, fresh);
            EXPECT_EQ(fresh.transfer, sequence[p].transfer);
        }
    }
}

TEST(DecodePlane, IsThePlaneOfEveryDecodedPose) {
    const Asset floats = make_example_asset(2, 3);
    for (const Asset& asset : {floats, quantise_example(floats), make_clustered_example(2, 3, 2),
                               make_clustered_example(2, 3, 2, true)}) {
        MeshDecoder decoder(asset.moving());
        for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
            for (uint32_t plane = 0; plane < (attribute == Attribute::geometry ? 3u : 12u);
                 ++plane) {
                const Eigen::MatrixXf all = decode_plane(asset.moving(), attribute, plane);
                ASSERT_EQ(all.cols(), 5);
                for (uint32_t p = 0; p < 5; ++p) {
                    DecodedPose pose;
                    decoder.decode(p, {}, pose);
                    const auto& values =
                        attribute == Attribute::geometry ? pose.positions : pose.transfer;
                    for (uint32_t v = 0; v < 4; ++v) {
                        // Sums of a few terms in another order.
                        EXPECT_NEAR(all(v, p), values[plane * 4 + v],
                                    1e-6f * (1.0f + 100.0f * std::abs(all(v, p))));
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace paim
