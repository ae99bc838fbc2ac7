// Glossy transfer in .bake directories, and as a bake of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/seed.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/bake/bake_manifest.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

// A square of two triangles, a triangle apart from it, and a vertex without a face.
const Topology kMesh{8, {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}}};
const Albedo kGrey{{Vec3f::Constant(0.5f)}};
const GlossMaterial kGold{"phong:0.5,32", Vec3f(1.0f, 0.8f, 0.4f)};
const GlossMaterial kLead{"cook-torrance:0.5,0.25", Vec3f::Ones()};
// Vertex 3 is of gold, so that its face is a glossy one.
const Materials kOneGlossy{{kGold}, {0, 0, 0, 1, 0, 0, 0, 0}};
const std::vector<uint32_t> kRows{1, 2, 3};

BakeIdentity identity_of(const Materials& materials) {
    BakeIdentity identity;
    identity.layout = {TransferKind::diffuse, 1, 1};
    identity.gloss = {{TransferKind::glossy, 2, 1, 2}, {kGold, kLead}};
    identity.rays = 64;
    identity.sampler = "cosine";
    identity.streams = "shared";
    identity.normals = "faces";
    identity.num_vertices = 8;
    identity.num_triangles = 3;
    identity.mesh_xxh3 = mesh_checksum(kMesh, kGrey, {}, materials);
    identity.poses = {{"a.obj", 1}, {"b.obj", 2}};
    return identity;
}

// Noise is stored in half precision, which holds multiples of 1/1024 below 1.
std::vector<float> random_values(size_t count, uint64_t seed) {
    RandomStream random(seed);
    std::vector<float> values(count);
    for (float& value : values) {
        value = std::round(static_cast<float>(random.uniform()) * 1024.0f) / 1024.0f;
    }
    return values;
}

BakedPose make_pose(uint64_t seed, size_t num_vertices, size_t num_rows) {
    BakedPose pose;
    pose.positions = random_values(3 * num_vertices, seed);
    pose.normals = random_values(3 * num_vertices, seed + 1);
    pose.transfer = random_values(num_vertices, seed + 2);
    pose.noise = random_values(num_vertices, seed + 3);
    pose.gloss = random_values(12 * num_rows, seed + 4);
    pose.gloss_noise = random_values(12 * num_rows, seed + 5);
    pose.statistics.transfer_rms = {0.5};
    pose.statistics.noise_rms = {0.25};
    pose.statistics.gloss_rms = {0.75, 1.5};
    pose.statistics.gloss_noise_rms = {0.125, 2.0};
    return pose;
}

class BakeGloss : public testing::Test {
  protected:
    std::string write(const Materials& materials, size_t num_rows, BakeIdentity identity) const {
        const BakeWriter writer(bake_, identity, kMesh, kGrey, {}, materials);
        for (uint32_t p = 0; p < 2; ++p) writer.write_pose(p, make_pose(10 * p, 8, num_rows));
        return bake_.string();
    }
    std::string write(const Materials& materials, size_t num_rows) const {
        return write(materials, num_rows, identity_of(materials));
    }

    TemporaryDirectory directory_;
    std::filesystem::path bake_ = directory_ / "x.bake";
};

TEST(GlossyRows, AreVerticesOfFacesThatHaveAGlossyOne) {
    EXPECT_EQ(glossy_rows(kMesh, kOneGlossy), kRows);
    EXPECT_TRUE(glossy_rows(kMesh, {}).empty());
    // Where all are glossy, those without a face are, too.
    EXPECT_EQ(glossy_rows(kMesh, {{kGold}, {1}}).size(), 8u);
}

TEST(GlossyRows, HaveTheTintsOfTheirMaterials) {
    const Albedo tints = tints_of(kOneGlossy, kRows);
    ASSERT_EQ(tints.values.size(), 3u);
    EXPECT_EQ(tints.values[0], Vec3f::Ones());
    EXPECT_EQ(tints.values[2], kGold.tint);
    EXPECT_EQ(tints_of({{kGold}, {1}}, kRows).values, std::vector<Vec3f>{kGold.tint});
}

TEST(MaterialsOfTwoMeshes, AreListedOnce) {
    Materials materials{{kGold}, {1}};
    materials.append({{kLead, kGold}, {2, 1, 0}}, 2, 3);
    EXPECT_EQ(materials.glossy, (std::vector<GlossMaterial>{kGold, kLead}));
    EXPECT_EQ(materials.of_vertex, (std::vector<uint16_t>{1, 1, 1, 2, 0}));
    Materials alike{{kGold}, {1}};
    alike.append({{kLead, kGold}, {2}}, 2, 3);
    EXPECT_EQ(alike.of_vertex, std::vector<uint16_t>{1});
}

TEST_F(BakeGloss, RoundTrips) {
    const BakeReader reader(write(kOneGlossy, 3));
    reader.verify_all();
    EXPECT_EQ(reader.identity(), identity_of(kOneGlossy));
    EXPECT_EQ(reader.gloss_rows(), kRows);
    EXPECT_EQ(reader.materials().of_vertex, kOneGlossy.of_vertex);
    const BakedPose pose = reader.read_pose(1), expected = make_pose(10, 8, 3);
    EXPECT_EQ(pose.gloss, expected.gloss);
    EXPECT_EQ(pose.gloss_noise, expected.gloss_noise);
    EXPECT_EQ(pose.transfer, expected.transfer);
    EXPECT_EQ(pose.statistics.gloss_rms, expected.statistics.gloss_rms);
}

TEST_F(BakeGloss, IsABakeOfItsOwn) {
    const BakeReader whole(write(kOneGlossy, 3));
    const BakeReader gloss = whole.gloss();
    EXPECT_EQ(gloss.identity().num_vertices, 3u);
    EXPECT_EQ(gloss.identity().layout, identity_of(kOneGlossy).gloss->layout);
    EXPECT_EQ(gloss.topology().triangles, (std::vector<Triangle>{{1, 0, 2}}));
    EXPECT_EQ(gloss.albedo().values[2], kGold.tint);
    EXPECT_EQ(gloss.read_statistics(0).noise_rms, (std::vector<double>{0.125, 2.0}));
    EXPECT_EQ(gloss.total_statistics().transfer_rms, (std::vector<double>{0.75, 1.5}));
    const BakedPose pose = make_pose(10, 8, 3);
    // Across the ends of planes.
    std::vector<float> rows(5);
    gloss.read_position_rows(1, 2, 5, rows.data());
    for (size_t j = 0; j < 5; ++j) {
        const size_t row = 2 + j;
        EXPECT_EQ(rows[j], pose.positions[row / 3 * 8 + kRows[row % 3]]) << j;
    }
    gloss.read_transfer_rows(1, 7, 5, rows.data());
    EXPECT_TRUE(std::equal(rows.begin(), rows.end(), pose.gloss.begin() + 7));
    const BakedPose of_gloss = gloss.read_pose(1);
    EXPECT_EQ(of_gloss.transfer, pose.gloss);
    EXPECT_EQ(of_gloss.noise, pose.gloss_noise);
    EXPECT_EQ(of_gloss.positions[4], pose.positions[8 + kRows[1]]);
    gloss.read_noise_rows(1, 7, 5, rows.data());
    EXPECT_TRUE(std::equal(rows.begin(), rows.end(), pose.gloss_noise.begin() + 7));
}

TEST_F(BakeGloss, HasAllVerticesWhereAllAreGlossy) {
    const Materials all{{kGold}, {1}};
    const BakeReader gloss = BakeReader(write(all, 8)).gloss();
    EXPECT_EQ(gloss.topology(), kMesh);
    EXPECT_EQ(gloss.albedo().values, std::vector<Vec3f>{kGold.tint});
}

TEST_F(BakeGloss, KeepsTheNumberThatFollowsARootMotion) {
    BakeIdentity identity = identity_of(kOneGlossy);
    identity.root_motion.resize(2);
    identity.root_motion[1].translation.x() = 1.0;
    identity.num_following = 4;
    const BakeReader reader(write(kOneGlossy, 3, identity));
    EXPECT_EQ(reader.identity(), identity);
    EXPECT_EQ(reader.gloss().identity().num_following, kAllVertices);
}

TEST_F(BakeGloss, OfStillMeshes) {
    BakeIdentity identity = identity_of(kOneGlossy);
    identity.still_meshes = {{"s.obj", 7}};
    const BakeWriter writer(bake_, identity, kMesh, kGrey, {}, kOneGlossy);
    for (uint32_t p = 0; p < 2; ++p) writer.write_pose(p, make_pose(10 * p, 8, 3));
    // The mesh lists its materials in another order than the identity.
    const Materials materials{{kLead}, {1, 1, 1}};
    const Topology triangle{3, {{0, 1, 2}}};
    writer.write_still_mesh({triangle, kGrey, make_pose(77, 3, 3), materials});
    EXPECT_TRUE(writer.has_still_mesh());
    const BakeReader reader(bake_);
    EXPECT_EQ(reader.still_mesh()->materials.of_vertex, (std::vector<uint16_t>{2, 2, 2}));
    EXPECT_EQ(reader.still_mesh()->pose.gloss, make_pose(77, 3, 3).gloss);
    EXPECT_EQ(reader.gloss().still_mesh()->pose.transfer, make_pose(77, 3, 3).gloss);
    EXPECT_EQ(reader.gloss().still_mesh()->topology, triangle);
}

TEST_F(BakeGloss, RefusesOtherMaterialsByName) {
    write(kOneGlossy, 3);
    BakeIdentity other = identity_of(kOneGlossy);
    other.gloss->materials[0].brdf = "phong:0.5,33";
    try {
        const BakeWriter writer(bake_, other, kMesh, kGrey, {}, {{other.gloss->materials[0]}, {1}});
        FAIL() << "expected a refusal";
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("gloss"), std::string::npos) << text;
        EXPECT_NE(text.find("phong:0.5,33"), std::string::npos) << text;
    }
}

TEST_F(BakeGloss, RefusesMaterialsThatAreNotThere) {
    write(kOneGlossy, 3);
    const std::filesystem::path manifest = bake_ / "manifest.json";
    const auto bytes = read_file(manifest, 1 << 20);
    const std::string text(bytes.begin(), bytes.end());
    const auto complaint = [&](const std::string& from, const std::string& to) -> std::string {
        std::string changed = text;
        const size_t place = changed.find(from);
        EXPECT_NE(place, std::string::npos) << from;
        changed.replace(place, from.size(), to);
        write_file(manifest, changed);
        try {
            const BakeReader reader(bake_);
            return "nothing";
        } catch (const Error& error) {
            return error.what();
        }
    };
    const auto expect_found = [](const std::string& in, const std::string& part) {
        EXPECT_NE(in.find(part), std::string::npos) << in;
    };
    expect_found(complaint("\"out_bands\": 2", "\"out_bands\": 9"), "out_bands");
    expect_found(complaint("\"materials\"", "\"minerals\""), "materials");
    expect_found(complaint("\"version\": 5", "\"version\": 6"), "version 6, expected 2 to 5");
    expect_found(complaint("\"gloss\"", "\"glass\""), "'gloss': expected an object");
}

}  // namespace
}  // namespace paim
