// .bake directories: round trip, going on, refusals, damage, hostile manifests.
#include "paim/format/bake/bake_directory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/seed.h"
#include "paim/format/bake/bake_manifest.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

namespace fs = std::filesystem;

const Topology kTetrahedron{4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
const Albedo kAlbedo{{Vec3f(0.1f, 0.2f, 0.3f)}};

BakeIdentity make_identity() {
    BakeIdentity identity;
    identity.layout = {TransferKind::diffuse, 2, 1};
    identity.rays = 64;
    identity.transfer_error = 0.1;
    identity.sampler = "cosine";
    identity.streams = "shared";
    identity.seed = 0xfedcba9876543210;  // more than a double holds
    identity.normals = "faces";
    identity.num_vertices = 4;
    identity.num_triangles = 4;
    identity.mesh_xxh3 = mesh_checksum(kTetrahedron, kAlbedo);
    identity.poses = {{"a.obj", 1}, {"b.obj", 0xffffffffffffffff}, {"c \"ü\".obj", 3}};
    return identity;
}

BakedPose make_pose(uint32_t p) {
    RandomStream random(p + 1);
    const auto fill = [&](size_t count) {
        std::vector<float> values(count);
        std::generate(values.begin(), values.end(),
                      [&] { return static_cast<float>(random.uniform()); });
        return values;
    };
    BakedPose pose{fill(12), fill(12), fill(16), fill(16), {}, {}, {}};
    // Noise is stored in half precision.
    for (float& value : pose.noise) value = std::round(value * 1024.0f) / 1024.0f;
    pose.statistics = {256, 17 + p, 1, 2, {0.25, 0.5}, {0.125 / (p + 1), 0.0}, {5 + p, 6 + p},
                       3,   {},     {}};
    return pose;
}

class BakeDirectory : public testing::Test {
  protected:
    BakeWriter writer(const BakeIdentity& identity = make_identity()) const {
        return {bake_, identity, kTetrahedron, kAlbedo};
    }
    void write_all() const {
        const BakeWriter all = writer();
        for (uint32_t p = 0; p < 3; ++p) all.write_pose(p, make_pose(p));
    }
    std::string text_of(const std::string& name) const {
        const auto bytes = read_file(bake_ / name, 1 << 20);
        return {bytes.begin(), bytes.end()};
    }
    // What a call complains about, which must be bad input.
    template <typename Call>
    static std::string complaint(const Call& call) {
        try {
            call();
            return "nothing";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
            return error.what();
        }
    }
    std::string reading_complaint() const {
        return complaint([&] { BakeReader(bake_).verify_all(); });
    }

    TemporaryDirectory directory_;
    fs::path bake_ = directory_ / "x.bake";
};

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(BakeDirectory, RoundTrips) {
    write_all();
    const BakeReader reader(bake_);
    EXPECT_EQ(reader.identity(), make_identity());
    EXPECT_EQ(reader.topology(), kTetrahedron);
    EXPECT_EQ(reader.albedo().values, kAlbedo.values);
    for (uint32_t p = 0; p < 3; ++p) {
        const BakedPose expected = make_pose(p);
        const BakedPose pose = reader.read_pose(p);
        EXPECT_EQ(pose.positions, expected.positions);
        EXPECT_EQ(pose.normals, expected.normals);
        EXPECT_EQ(pose.transfer, expected.transfer);
        EXPECT_EQ(pose.noise, expected.noise);
        for (const PoseStatistics& statistics : {pose.statistics, reader.read_statistics(p)}) {
            EXPECT_EQ(statistics.rays, expected.statistics.rays);
            EXPECT_EQ(statistics.occluded, expected.statistics.occluded);
            EXPECT_EQ(statistics.zero_normals, expected.statistics.zero_normals);
            EXPECT_EQ(statistics.back_hits, 3u);
            EXPECT_EQ(statistics.above_target, expected.statistics.above_target);
            EXPECT_EQ(statistics.transfer_rms, expected.statistics.transfer_rms);
            EXPECT_EQ(statistics.noise_rms, expected.statistics.noise_rms);
            EXPECT_EQ(statistics.mesh.zero_area_faces, 5 + p);
            EXPECT_EQ(statistics.mesh.coincident_faces, 6 + p);
        }
        // Rows, as the encoder streams them.
        std::vector<float> rows(5);
        reader.read_position_rows(p, 7, 5, rows.data());
        EXPECT_TRUE(std::equal(rows.begin(), rows.end(), expected.positions.begin() + 7));
        reader.read_transfer_rows(p, 11, 5, rows.data());
        EXPECT_TRUE(std::equal(rows.begin(), rows.end(), expected.transfer.begin() + 11));
        reader.read_noise_rows(p, 11, 5, rows.data());
        EXPECT_TRUE(std::equal(rows.begin(), rows.end(), expected.noise.begin() + 11));
    }
    reader.verify_all();
}

TEST_F(BakeDirectory, NamesTheFirstValueThatIsNoNumber) {
    write_all();
    BakedPose pose = make_pose(2);
    pose.transfer[9] = std::nanf("");
    pose.transfer[13] = std::nanf("");
    writer().write_pose(2, pose);
    const std::string complaint = reading_complaint();
    expect_contains(complaint, bake_pose_file(bake_, 2).string());
    expect_contains(complaint, "value 9 is nan, expected a finite number");
}

TEST_F(BakeDirectory, GoesOnWhereItStopped) {
    writer().write_pose(1, make_pose(1));
    const BakeWriter again = writer();
    EXPECT_FALSE(again.has_pose(0));
    EXPECT_TRUE(again.has_pose(1));
    EXPECT_FALSE(again.has_pose(2));
    expect_contains(reading_complaint(), "2 of 3 poses are missing, the first is 0");
    again.write_pose(0, make_pose(0));
    again.write_pose(2, make_pose(2));
    EXPECT_EQ(reading_complaint(), "nothing");
}

TEST_F(BakeDirectory, ClearsWhatKilledWritersLeft) {
    writer();
    write_file(bake_ / "pose_000001.bin.77-3.tmp", "half");
    write_file(bake_ / "notes.tmp", "not ours");
    AtomicFile busy(bake_ / "pose_000002.bin");  // another process, still at it
    busy.write("so far");
    writer();
    EXPECT_FALSE(fs::exists(bake_ / "pose_000001.bin.77-3.tmp"));
    EXPECT_TRUE(fs::exists(bake_ / "notes.tmp"));
    busy.commit();
    EXPECT_EQ(text_of("pose_000002.bin"), "so far");
}

TEST_F(BakeDirectory, TakesABeginningForItsOwnAndNothingElse) {
    fs::create_directory(bake_);
    write_file(bake_ / "mesh.bin", "as far as it came");
    write_file(bake_ / "manifest.json.12-3.tmp", "{");
    write_all();
    EXPECT_EQ(reading_complaint(), "nothing");

    fs::remove(bake_ / "manifest.json");  // poses without a manifest are no bake that was begun
    expect_contains(complaint([&] { writer(); }), "is not empty and not a bake (no manifest.json)");
}

TEST_F(BakeDirectory, RefusesOtherIdentitiesByName) {
    write_all();
    const auto refusal = [&](const auto& change) {
        BakeIdentity identity = make_identity();
        change(identity);
        return complaint([&] { writer(identity); });
    };
    expect_contains(refusal([](auto& i) { i.layout.in_bands = 3; }),
                    "(bands: 2 there, 3 asked for)");
    expect_contains(refusal([](auto& i) { i.layout.channels = 3; }),
                    "(channels: 1 there, 3 asked for)");
    expect_contains(refusal([](auto& i) { i.rays = 2; }), "(rays: 64 there, 2 asked for)");
    expect_contains(refusal([](auto& i) { ++i.seed; }), "(seed: ");
    expect_contains(refusal([](auto& i) { i.normals = "file"; }),
                    "(normals: faces there, file asked for)");
    expect_contains(refusal([](auto& i) { i.bounces = 3; }), "(bounces: 0 there, 3 asked for)");
    expect_contains(refusal([](auto& i) { i.floor = "wood"; }),
                    "(floor: none there, wood asked for)");
    expect_contains(refusal([](auto& i) { ++i.num_vertices; }), "(vertices: 4 there, 5 asked for)");
    expect_contains(refusal([](auto& i) { ++i.num_triangles; }),
                    "(triangles: 4 there, 5 asked for)");
    expect_contains(refusal([](auto& i) { i.poses.pop_back(); }), "(poses: 3 there, 2 asked for)");
    expect_contains(refusal([](auto& i) { ++i.mesh_xxh3; }),
                    "(checksum of faces, albedo and texture: ");
    expect_contains(refusal([](auto& i) { i.poses[1].name = "z.obj"; }), "(pose 1: b.obj (");
    expect_contains(refusal([](auto& i) { i.poses[2].xxh3 = 4; }),
                    "(0000000000000003) there, c \"ü\".obj (0000000000000004) asked for)");
    EXPECT_EQ(reading_complaint(), "nothing");  // it is as it was
}

TEST_F(BakeDirectory, ManifestKeepsFloorAndBounces) {
    BakeIdentity identity = make_identity();
    const std::string without = manifest_text(identity);
    identity.floor = "100 vertices at y = -1";
    identity.bounces = 2;
    writer(identity);
    EXPECT_EQ(read_manifest(bake_ / "manifest.json"), identity);
    // A bake without them has the manifest, and so the checksum, that it had before there were any.
    EXPECT_EQ(without.find("floor"), std::string::npos);
    EXPECT_EQ(without.find("bounces"), std::string::npos);
}

TEST_F(BakeDirectory, KeepsStillMeshesAndRefusesOthersByName) {
    BakeIdentity identity = make_identity();
    identity.still_meshes = {{"wall.obj", 5}, {"tree.obj", 6}};
    BakedStillMesh still_mesh{kTetrahedron, kAlbedo, make_pose(7)};
    {
        const BakeWriter all = writer(identity);
        EXPECT_FALSE(all.has_still_mesh());
        all.write_still_mesh(still_mesh);
        EXPECT_TRUE(all.has_still_mesh());
        for (uint32_t p = 0; p < 3; ++p) all.write_pose(p, make_pose(p));
    }
    const BakeReader reader(bake_);
    EXPECT_EQ(reader.identity(), identity);
    ASSERT_TRUE(reader.still_mesh());
    EXPECT_EQ(reader.still_mesh()->topology, still_mesh.topology);
    EXPECT_EQ(reader.still_mesh()->albedo.values, still_mesh.albedo.values);
    EXPECT_EQ(reader.still_mesh()->pose.positions, still_mesh.pose.positions);
    EXPECT_EQ(reader.still_mesh()->pose.normals, still_mesh.pose.normals);
    EXPECT_EQ(reader.still_mesh()->pose.transfer, still_mesh.pose.transfer);

    const auto refusal = [&](const auto& change) {
        BakeIdentity other = identity;
        change(other);
        return complaint([&] { writer(other); });
    };
    expect_contains(refusal([](auto& i) { i.still_meshes.clear(); }),
                    "(static files: 2 there, 0 asked for)");
    expect_contains(refusal([](auto& i) { i.still_meshes[1].name = "bush.obj"; }),
                    "(static file 1: tree.obj (0000000000000006) there, bush.obj (");
    expect_contains(refusal([](auto& i) { ++i.still_meshes[0].xxh3; }),
                    "(static file 0: wall.obj (");

    const std::string whole = text_of("scenery.bin");
    for (size_t j = 0; j < 40; ++j) {
        std::string damaged = whole;
        damaged[whole.size() * j / 40] ^= 4;
        write_file(bake_ / "scenery.bin", damaged);
        const std::string message = reading_complaint();
        EXPECT_EQ(writer(identity).has_still_mesh(), message == "nothing") << j;
        if (message != "nothing") expect_contains(message, "scenery.bin: ");
        write_file(bake_ / "scenery.bin", whole.substr(0, whole.size() * j / 40));
        EXPECT_FALSE(writer(identity).has_still_mesh()) << "cut at " << whole.size() * j / 40;
    }
    fs::remove(bake_ / "scenery.bin");
    expect_contains(reading_complaint(), "scenery.bin: cannot open");

    // A bake without has none, whatever lies in the folder.
    EXPECT_FALSE(manifest_text(make_identity()).find("static") != std::string::npos);
}

TEST_F(BakeDirectory, KeepsTheOriginToTheLastDigit) {
    BakeIdentity identity = make_identity();
    // Without one the manifest is what it was before there was an origin.
    EXPECT_EQ(manifest_text(identity).find("origin"), std::string::npos);
    identity.origin = Vec3d(1.0 / 3.0, -1e30, 0x1.fffffffffffffp-40);
    const BakeWriter first = writer(identity);
    for (uint32_t p = 0; p < 3; ++p) first.write_pose(p, make_pose(p));
    EXPECT_EQ(BakeReader(bake_).identity(), identity);
    BakeIdentity other = identity;
    other.origin.x() = 0.0;
    expect_contains(complaint([&] { writer(other); }), "(origin: (0.3333333333333333, -1e+30, ");

    const std::string text = text_of("manifest.json");
    for (const std::string wrong : {"7", "[1, 2]", "[1, 2, \"3\"]", "[1, 2, 1e300]", "[]"}) {
        std::string changed = text;
        const size_t at = changed.find('[', changed.find("\"origin\""));
        changed.replace(at, changed.find(']', at) + 1 - at, wrong);
        write_file(bake_ / "manifest.json", changed);
        expect_contains(reading_complaint(), "'origin': expected three numbers, got ");
    }
}

// A body that turns far from the origin may have a translation that no float is as large as.
TEST_F(BakeDirectory, DoesNotWriteWhatItWouldNotRead) {
    BakeIdentity identity = make_identity();
    identity.root_motion.resize(3);
    for (const double translation : {3.5e38, 5e38}) {
        identity.root_motion[1].translation.x() = translation;
        const std::string refusal = complaint([&] { writer(identity); });
        expect_contains(refusal, (bake_ / kManifestName).string());
        expect_contains(refusal, "expected");
        EXPECT_FALSE(fs::exists(bake_));
    }
    identity.root_motion[1].translation.x() = 3e38;
    writer(identity);
    EXPECT_EQ(read_manifest(bake_ / kManifestName).root_motion[1].translation.x(), 3e38);
}

TEST_F(BakeDirectory, NamesThatAreNotTextStillResume) {
    BakeIdentity identity = make_identity();
    identity.poses[0].name = "caf\xe9.obj";  // Latin-1
    writer(identity).write_pose(0, make_pose(0));
    EXPECT_TRUE(writer(identity).has_pose(0));
}

TEST_F(BakeDirectory, DamagedPosesAreNotThere) {
    write_all();
    const std::string whole = text_of("pose_000001.bin");
    const BakeWriter again = writer();
    for (size_t j = 0; j < 40; ++j) {  // header, table, metadata and every plane
        std::string damaged = whole;
        damaged[whole.size() * j / 40] ^= 4;
        write_file(bake_ / "pose_000001.bin", damaged);
        const std::string message = reading_complaint();
        // A bit of the padding between sections counts for nothing.
        EXPECT_EQ(again.has_pose(1), message == "nothing") << "byte " << whole.size() * j / 40;
        if (!again.has_pose(1)) expect_contains(message, "pose_000001.bin: ");
        write_file(bake_ / "pose_000001.bin", whole.substr(0, whole.size() * j / 40));
        EXPECT_FALSE(again.has_pose(1)) << "cut at " << whole.size() * j / 40;
    }
    write_file(bake_ / "pose_000001.bin", text_of("pose_000002.bin"));
    EXPECT_FALSE(again.has_pose(1)) << "pose 2 in its place";
    write_file(bake_ / "pose_000001.bin", whole);
    EXPECT_TRUE(again.has_pose(1));
}

TEST_F(BakeDirectory, PosesOfOtherBakesAreNotTaken) {
    write_all();
    BakeIdentity other = make_identity();
    ++other.seed;
    BakeWriter(directory_ / "y.bake", other, kTetrahedron, kAlbedo).write_pose(1, make_pose(1));
    fs::copy(directory_ / "y.bake" / "pose_000001.bin", bake_ / "pose_000001.bin",
             fs::copy_options::overwrite_existing);
    EXPECT_FALSE(writer().has_pose(1));
    expect_contains(reading_complaint(), "pose_000001.bin: belongs to bake ");
}

TEST_F(BakeDirectory, RefusesHostileManifests) {
    write_all();
    const std::string whole = text_of("manifest.json");
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        const size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        write_file(bake_ / "manifest.json", text.replace(at, from.size(), to));
        const std::string message = reading_complaint();
        expect_contains(message, bake_.string());
        EXPECT_EQ(complaint([&] { writer(); }).find("nothing"), std::string::npos);
        return message;
    };
    const auto refuse = [&](const std::string& from, const std::string& to,
                            const std::string& part) { expect_contains(with(from, to), part); };
    refuse("\"bands\": 2", "\"bands\": 0", "'bands': expected 1 to");
    refuse("\"bands\": 2", "\"bands\": 4294967297", "'bands': expected 1 to");
    refuse("\"bands\": 2", "\"bands\": -1", "'bands': expected 1 to");
    refuse("\"bands\": 2", "\"bands\": 2.5", "'bands': expected 1 to");
    refuse("\"bands\": 2", "\"bands\": \"2\"", "'bands': expected 1 to");
    refuse("\"bands\": 2", "\"bands\": 1e999", "not a JSON object");
    refuse("\"bands\": 2,", "", "'bands' is missing");
    refuse("\"bands\": 2", "\"bands\": 3", "belongs to bake");
    refuse("\"channels\": 1", "\"channels\": 4", "'channels': expected 1 to 3, got 4");
    refuse("\"num_vertices\": 4", "\"num_vertices\": 2147483648", "'num_vertices': expected 1 to");
    refuse("\"num_vertices\": 4", "\"num_vertices\": 2147483647", "mesh.bin: ");
    refuse("\"num_vertices\": 4", "\"num_vertices\": 3", "mesh.bin: ");
    refuse("\"seed\": \"fedc", "\"seed\": \"wxyz", "'seed': expected 16 hexadecimal digits");
    refuse("\"seed\": \"fedc", "\"seed\": \"fed", "'seed': expected 16 hexadecimal digits");
    refuse("\"mesh_xxh3\": \"", "\"mesh_xxh3\": \"0", "expected 16 hexadecimal digits");
    refuse("\"poses\": [", "\"poses\": [7,", "not a JSON object");
    refuse("\"poses\": [", "\"poses\": [], \"more\": [", "expected a list of at least one pose");
    refuse("\"poses\": [", "\"poses\": 7, \"more\": [", "expected a list of at least one pose");
    // Version 3 has a root motion for each pose.
    refuse("\"version\": 2", "\"version\": 3", "'root' is missing");
    const std::string named = "\"version\": 3, \"poses\": [{\"root\": [";
    const std::string rest = "], \"name\": \"a\", \"xxh3\": \"0123456789abcdef\"}], \"more\": [";
    for (const char* const root : {"0,0,0,0,0", "0,0,0,0,0,\"1\"", "0,0,0,1e300,0,0"}) {
        std::string text = whole;
        text.replace(text.find("\"poses\": ["), 10, named + root + rest);
        text.replace(text.find("\"version\": 2,"), 13, "");
        write_file(bake_ / "manifest.json", text);
        expect_contains(reading_complaint(), "'root': expected");
    }
    refuse("paim-bake", "paim-cake", "not a bake's manifest");
    refuse("{", "[[[[", "not a JSON object");
    for (const std::string& deep :
         {std::string(100'000, '['),
          "{\"poses\": " + std::string(100'000, '[') + std::string(100'000, ']') + "}"}) {
        write_file(bake_ / "manifest.json", deep);
        expect_contains(reading_complaint(), "nested more than 16 deep");
    }

    // What a later version wrote is not damaged.
    write_file(bake_ / "manifest.json", whole);
    std::string later = whole;
    later.replace(later.find("\"version\": 2"), 12, "\"version\": 6");
    write_file(bake_ / "manifest.json", later);
    try {
        BakeReader reader(bake_);
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        expect_contains(error.what(), "bake version 6, expected 2 to 5");
    }
}

}  // namespace
}  // namespace paim
