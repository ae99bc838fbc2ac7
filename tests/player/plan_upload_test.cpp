// Texture layout and limits, without OpenGL.
#include "player/render/plan_upload.h"

#include <gtest/gtest.h>

#include <string>

#include "paim/base/error.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/svd/svd_transfer.h"
#include "player/gl/data_texture.h"
#include "player/render/svd/svd_textures.h"
#include "player/render/transfer_textures.h"

namespace paim::player {
namespace {

// A matrix of which only the dimensions matter.
LowRank matrix_of(uint32_t num_points, uint32_t num_planes, uint32_t num_components) {
    LowRank matrix;
    matrix.num_points = num_points;
    matrix.num_planes = num_planes;
    matrix.num_components = num_components;
    matrix.num_poses = 10;
    return matrix;
}

// A mesh of which only the dimensions matter.
CodedMesh dimensions(uint32_t num_vertices, uint32_t bands, uint32_t channels,
                     uint32_t geometry_components, uint32_t transfer_components) {
    CodedMesh mesh;
    mesh.topology.num_vertices = num_vertices;
    mesh.layout.in_bands = bands;
    mesh.layout.channels = channels;
    mesh.positions = matrix_of(num_vertices, 3, geometry_components);
    mesh.transfer =
        SvdTransfer(matrix_of(num_vertices, mesh.layout.num_planes(), transfer_components));
    return mesh;
}

std::string refusal(const CodedMesh& mesh, const DecodeLimits& limits, int max_texture_size) {
    try {
        plan_upload(mesh, limits, max_texture_size);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        return error.what();
    }
    return {};
}

TEST(PlanUpload, CountsGroupsOfFourPerChannel) {
    const CodedMesh mesh = dimensions(100, 5, 3, 7, 11);
    const UploadPlan plan = plan_upload(mesh, {}, 1024);
    EXPECT_EQ(plan.groups_per_channel(), 7u);  // 25 coefficients
    EXPECT_EQ(plan.num_groups(), 21u);
    EXPECT_EQ(geometry_texels(mesh, 7), 700);
    EXPECT_EQ(svd_transfer_texels(mesh, 11, 5), 11 * 21 * 100);
    EXPECT_EQ(svd_transfer_texels(mesh, 11, 2), 11 * 3 * 100);
}

TEST(PlanUpload, TakesTheLimits) {
    const CodedMesh mesh = dimensions(100, 5, 1, 7, 11);
    const UploadPlan plan = plan_upload(mesh, {3, 4, 2}, 1024);
    EXPECT_EQ(plan.geometry_components, 3u);
    EXPECT_EQ(plan.transfer_components, 4u);
    EXPECT_EQ(plan.layout.in_bands, 2u);
    const UploadPlan all = plan_upload(mesh, {}, 1024);
    EXPECT_EQ(all.geometry_components, 7u);
    EXPECT_EQ(all.transfer_components, 11u);
    EXPECT_EQ(all.layout.in_bands, 5u);
}

TEST(PlanUpload, NamesTheTextureLimitAndWhatWouldFit) {
    // 64 x 64 = 4096 texels; a component of transfer takes 3 channels x 100 vertices.
    const CodedMesh mesh = dimensions(100, 2, 3, 40, 14);
    EXPECT_EQ(refusal(mesh, {}, 64),
              "14 components of transfer need 4200 texels, this driver's largest texture "
              "(GL_MAX_TEXTURE_SIZE 64) holds 4096: 13 components would fit");
    EXPECT_EQ(refusal(mesh, {40, 13, 2}, 64), "");
    EXPECT_EQ(refusal(dimensions(100, 1, 1, 41, 1), {}, 64),
              "41 components of geometry need 4100 texels, this driver's largest texture "
              "(GL_MAX_TEXTURE_SIZE 64) holds 4096: 40 components would fit");
    EXPECT_NE(refusal(dimensions(2000, 4, 1, 1, 0), {}, 64).find("GL_MAX_TEXTURE_SIZE 64"),
              std::string::npos);
}

// 100 vertices, clusters of 6 components: 2 texels of coefficients a vertex; 1 + 3 · 2 texels of
// radiance a cluster.
TEST(PlanUpload, HoldsClusters) {
    CodedMesh mesh = dimensions(100, 8, 3, 1, 0);
    const auto set_clusters = [&](uint32_t num_clusters) {
        VertexClusters clusters;
        clusters.num_clusters = num_clusters;
        clusters.num_components = 6;
        // 50 components over the poses, which would not fit.
        LowRank bases = matrix_of(clusters.num_rows(), mesh.layout.num_planes(), 50);
        mesh.transfer = CpcaTransfer(std::move(bases), std::move(clusters));
    };
    const auto largest_texture = [&](const DecodeLimits& limits) {
        return find_uploader(mesh).largest_texture(mesh, plan_upload(mesh, limits, 16), 16);
    };
    set_clusters(20);
    const UploadPlan plan = plan_upload(mesh, {}, 16);
    EXPECT_EQ(plan.vertex_components, 6u);
    EXPECT_EQ(plan.width_log2, 4);
    EXPECT_EQ(largest_texture({}), 100 * 2);  // of coefficients
    EXPECT_EQ(largest_texture({.vertex_components = 4}), 100);
    EXPECT_NE(refusal(mesh, {}, 14).find("6 components of 20 clusters and 100 vertices need 200"),
              std::string::npos);
    EXPECT_EQ(refusal(mesh, {.vertex_components = 4}, 14), "");
    set_clusters(36);
    EXPECT_EQ(largest_texture({}), 36 * 7);  // of radiance
    EXPECT_EQ(largest_texture({.vertex_components = 4}), 36 * 4);
    set_clusters(40);
    EXPECT_NE(refusal(mesh, {}, 16).find("need 280 texels"), std::string::npos);
}

// Shaders count texels in 32 bits, whatever the driver's textures hold.
TEST(PlanUpload, StaysWithinThirtyTwoBits) {
    const CodedMesh mesh = dimensions(1 << 20, 2, 1, 3000, 1);
    EXPECT_NE(refusal(mesh, {}, 65536).find("holds 2147483647: 2047 components would fit"),
              std::string::npos);
}

TEST(FittingWidth, IsTheLeastPowerOfTwoThatHolds) {
    EXPECT_EQ(gl::fitting_width_log2(1, 16384), 10);
    EXPECT_EQ(gl::fitting_width_log2(int64_t{1024} * 16384, 16384), 10);
    EXPECT_EQ(gl::fitting_width_log2(int64_t{1024} * 16384 + 1, 16384), 11);
    EXPECT_EQ(gl::fitting_width_log2(int64_t{16384} * 16384, 16384), 14);
    EXPECT_EQ(gl::fitting_width_log2(int64_t{16384} * 16384 + 1, 16384), -1);
    EXPECT_EQ(gl::fitting_width_log2(1, 64), 6);
    // A limit that is no power of two: the width is the power below it.
    EXPECT_EQ(gl::fitting_width_log2(int64_t{64} * 100, 100), 6);
    EXPECT_EQ(gl::fitting_width_log2(int64_t{64} * 100 + 1, 100), -1);
}

}  // namespace
}  // namespace paim::player
