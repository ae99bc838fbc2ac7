// Texture layout and limits, without OpenGL.
#include "player/render/upload_plan.h"

#include <gtest/gtest.h>

#include <string>

#include "paim/base/error.h"
#include "player/gl/data_texture.h"

namespace paim::player {
namespace {

// A model of which only the dimensions matter.
Asset dimensions(uint32_t num_vertices, uint32_t bands, uint32_t channels,
                 uint32_t geometry_components, uint32_t transfer_components) {
    Asset model;
    model.moving().topology.num_vertices = num_vertices;
    model.moving().layout.in_bands = bands;
    model.moving().layout.channels = channels;
    model.moving().positions.num_points = model.moving().transfer->matrix.num_points = num_vertices;
    model.moving().positions.num_planes = 3;
    model.moving().transfer->matrix.num_planes = model.moving().layout.num_planes();
    model.moving().positions.num_components = geometry_components;
    model.moving().transfer->matrix.num_components = transfer_components;
    model.moving().positions.num_poses = model.moving().transfer->matrix.num_poses = 10;
    return model;
}

std::string refusal(const Asset& model, const DecodeLimits& limits, int max_texture_size) {
    try {
        plan_upload(model, limits, max_texture_size);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        return error.what();
    }
    return {};
}

TEST(UploadPlan, CountsGroupsOfFourPerChannel) {
    const Asset model = dimensions(100, 5, 3, 7, 11);
    const UploadPlan plan = plan_upload(model, {}, 1024);
    EXPECT_EQ(plan.groups_per_channel, 7u);  // 25 coefficients
    EXPECT_EQ(plan.num_groups(), 21u);
    EXPECT_EQ(geometry_texels(model, 7), 700);
    EXPECT_EQ(transfer_texels(model, 11, 5), 11 * 21 * 100);
    EXPECT_EQ(transfer_texels(model, 11, 2), 11 * 3 * 100);
}

TEST(UploadPlan, TakesTheLimits) {
    const Asset model = dimensions(100, 5, 1, 7, 11);
    const UploadPlan plan = plan_upload(model, {3, 4, 2}, 1024);
    EXPECT_EQ(plan.geometry_components, 3u);
    EXPECT_EQ(plan.transfer_components, 4u);
    EXPECT_EQ(plan.layout.in_bands, 2u);
    const UploadPlan all = plan_upload(model, {}, 1024);
    EXPECT_EQ(all.geometry_components, 7u);
    EXPECT_EQ(all.transfer_components, 11u);
    EXPECT_EQ(all.moving().layout.in_bands, 5u);
}

TEST(UploadPlan, NamesTheTextureLimitAndWhatWouldFit) {
    // 64 x 64 = 4096 texels; a component of transfer takes 3 channels x 100 vertices.
    const Asset model = dimensions(100, 2, 3, 40, 14);
    EXPECT_EQ(refusal(model, {}, 64),
              "14 components of transfer need 4200 texels, this driver's largest texture "
              "(GL_MAX_TEXTURE_SIZE 64) holds 4096: 13 components would fit");
    EXPECT_EQ(refusal(model, {40, 13, 2}, 64), "");
    EXPECT_EQ(refusal(dimensions(100, 1, 1, 41, 1), {}, 64),
              "41 components of geometry need 4100 texels, this driver's largest texture "
              "(GL_MAX_TEXTURE_SIZE 64) holds 4096: 40 components would fit");
    EXPECT_NE(refusal(dimensions(2000, 4, 1, 1, 0), {}, 64).find("GL_MAX_TEXTURE_SIZE 64"),
              std::string::npos);
}

// 100 vertices, 20 clusters of 6 components: 2 texels of coefficients a vertex; 1 + 3 · 2 texels of
// light products a cluster.
TEST(UploadPlan, HoldsClusters) {
    Asset model = dimensions(100, 8, 3, 1, 50);  // whose transfer would not fit
    model.clusters.num_clusters = 20;
    model.clusters.num_components = 6;
    model.moving().transfer->matrix.num_points = model.clusters.num_rows();
    const UploadPlan plan = plan_upload(model, {}, 16);
    EXPECT_EQ(plan.cluster_components, 6u);
    EXPECT_EQ(plan.cluster_groups(), 2u);
    EXPECT_EQ(plan.product_texels(), 7u);
    EXPECT_EQ(plan.width_log2, 4);
    EXPECT_EQ(plan_upload(model, {.cluster_components = 4}, 16).product_texels(), 4u);
    EXPECT_NE(refusal(model, {}, 14).find("6 components of 20 clusters and 100 vertices need 200"),
              std::string::npos);
    EXPECT_EQ(refusal(model, {.cluster_components = 4}, 14), "");
    model.clusters.num_clusters = 40;  // 280 texels of light products
    EXPECT_NE(refusal(model, {}, 16).find("need 280 texels"), std::string::npos);
}

// Shaders count texels in 32 bits, whatever the driver's textures hold.
TEST(UploadPlan, StaysWithinThirtyTwoBits) {
    const Asset model = dimensions(1 << 20, 2, 1, 3000, 1);
    EXPECT_NE(refusal(model, {}, 65536).find("holds 2147483647: 2047 components would fit"),
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
