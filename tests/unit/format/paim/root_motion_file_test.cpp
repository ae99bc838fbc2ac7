// Root motion in .paim files and manifests of bakes.
#include <gtest/gtest.h>

#include <limits>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/bake/bake_manifest.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"
#include "tests/unchecked_file.h"

namespace paim {
namespace {

RootMotion some_motion(uint32_t num_poses) {
    RootMotion motion(num_poses);
    for (uint32_t p = 0; p < num_poses; ++p) {
        motion[p].rotation = rotation_of(kRotationUnit_rad * p * Vec3d(1e5, 123457, -999));
        motion[p].translation = Vec3d(1.0 / 3.0, 1e5 * p, -2.0);
    }
    return motion;
}

TEST(RootMotionInFiles, RoundTrips) {
    const TemporaryDirectory directory;
    for (const bool packed : {false, true}) {
        Asset asset = packed ? make_packed_example(false) : make_example_asset();
        asset.moving().root_motion = some_motion(asset.num_poses());
        write_paim(directory / "x.paim", asset);
        const Asset read = read_paim(directory / "x.paim");
        ASSERT_EQ(read.moving().root_motion.size(), asset.num_poses());
        EXPECT_EQ(read.moving().root_motion, asset.moving().root_motion);
        EXPECT_EQ(std::filesystem::file_size(directory / "x.paim"), paim_size_bytes(asset));
        // What is read is written as it was.
        write_paim(directory / "y.paim", read);
        EXPECT_EQ(read_file(directory / "x.paim", 1 << 20),
                  read_file(directory / "y.paim", 1 << 20));
    }
}

// Readers of earlier versions compare the kind of transfer with "diffuse".
TEST(RootMotionInFiles, IsAKindOfTransferOfItsOwn) {
    const TemporaryDirectory directory;
    Asset asset = make_example_asset();
    for (const bool moves : {false, true}) {
        if (moves) asset.moving().root_motion = some_motion(asset.num_poses());
        write_paim(directory / "x.paim", asset);
        const std::vector<char> bytes = read_file(directory / "x.paim", 1 << 20);
        const std::string text(bytes.begin(), bytes.end());
        EXPECT_EQ(text.find("\"transfer_kind\": \"diffuse\"") != std::string::npos, !moves);
        EXPECT_EQ(text.find("\"transfer_kind\": \"diffuse-local\"") != std::string::npos, moves);
    }
}

// readable  an asset of the same shapes, if writers refuse the numbers of this one
void expect_refused(const Asset& asset, const std::string& what, const Asset* readable = nullptr) {
    const TemporaryDirectory directory;
    if (readable != nullptr) {
        write_unchecked(directory / "x.paim", *readable, asset);
    } else {
        write_paim(directory / "x.paim", asset);
    }
    try {
        read_paim(directory / "x.paim");
        FAIL() << "expected an error about " << what;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
}

// scale  of the mean positions, which are up to 1
void expect_refused(RootMotion motion, const std::string& what, float scale = 1.0f) {
    Asset readable = make_example_asset();
    readable.moving().root_motion = some_motion(readable.num_poses());
    Asset asset = readable;
    std::vector<float> mean = asset.moving().positions.mean.floats();
    for (float& value : mean) value *= scale;
    asset.moving().positions.mean = std::move(mean);
    asset.moving().root_motion = std::move(motion);
    expect_refused(asset, what, &readable);
}

TEST(RootMotionInFiles, RefusesNumbersThatAreNoMotion) {
    RootMotion motion = some_motion(5);
    motion[2].rotation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
    expect_refused(motion, "pose 2: a rotation by");
    motion = some_motion(5);
    motion[4].translation.y() = std::numeric_limits<double>::quiet_NaN();
    expect_refused(motion, "pose 4: a translation of");
    motion[4].translation.y() = 1e39;
    expect_refused(motion, "pose 4: a translation of");
    // A float by itself, but not with the shape added.
    motion[4].translation.y() = double{std::numeric_limits<float>::max()};
    expect_refused(motion, "decode to numbers of up to", 1e37f);
    Asset asset = make_example_asset();
    asset.moving().root_motion = some_motion(3);
    expect_refused(asset, "expected 5 x 6");
    EXPECT_THROW(root_motion_of({0, 0, 4, 0, 0, 0}, "x"), Error);
}

// Two triangles, of which the second does not follow.
Asset example_on_floor() {
    Asset asset = make_example_asset();
    CodedMesh& mesh = asset.moving();
    mesh.topology.triangles = {{0, 1, 0}, {2, 3, 2}};
    mesh.root_motion = some_motion(asset.num_poses());
    mesh.num_following = 2;
    return asset;
}

TEST(RootMotionInFiles, MayLeaveAFloorInItsPlace) {
    const TemporaryDirectory directory;
    Asset asset = example_on_floor();
    write_paim(directory / "x.paim", asset);
    EXPECT_EQ(read_paim(directory / "x.paim").moving().num_following, 2u);
    // Readers of earlier versions refuse this kind.
    const std::vector<char> bytes = read_file(directory / "x.paim", 1 << 20);
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_NE(text.find("\"transfer_kind\": \"diffuse-local-on-floor\""), std::string::npos);
    // All follow: no floor.
    asset.moving().num_following = 4;
    write_paim(directory / "x.paim", asset);
    EXPECT_EQ(read_paim(directory / "x.paim").moving().num_following, kAllVertices);
}

TEST(RootMotionInFiles, RefusesAFloorAmongTheTrianglesOfTheBody) {
    for (const Triangle& odd : {Triangle{0, 2, 1}, Triangle{1, 0, 1}}) {
        Asset asset = example_on_floor();
        asset.moving().topology.triangles.push_back(odd);
        expect_refused(asset, "triangle 2");
    }
}

TEST(RootMotionInManifests, RoundTrips) {
    const TemporaryDirectory directory;
    BakeIdentity identity;
    identity.layout = {TransferKind::diffuse, 3, 1};
    identity.rays = 16;
    identity.num_vertices = identity.num_triangles = 4;
    identity.poses = {{"a", 1}, {"b", 2}, {"c", 3}};
    const auto read = [&] {
        const std::string text = manifest_text(identity);
        write_file(directory / "manifest.json", text);
        return read_manifest(directory / "manifest.json");
    };
    EXPECT_TRUE(read().root_motion.empty());
    identity.root_motion = some_motion(3);
    const BakeIdentity found = read();
    ASSERT_EQ(found.root_motion.size(), 3u);
    EXPECT_EQ(found.root_motion, identity.root_motion);
    EXPECT_TRUE(first_difference(found, found).empty());
    BakeIdentity other = found;
    other.root_motion[1].translation.x() += 1e-9;
    EXPECT_NE(first_difference(found, other).find("root motion"), std::string::npos);
    EXPECT_NE(identity_checksum(found), identity_checksum(other));
    // A floor that does not follow.
    identity.num_following = 2;
    const BakeIdentity on_floor = read();
    EXPECT_EQ(on_floor, identity);
    EXPECT_NE(first_difference(found, on_floor).find("vertices that follow"), std::string::npos);
    EXPECT_NE(identity_checksum(found), identity_checksum(on_floor));
}

}  // namespace
}  // namespace paim
