// Odd and far-away meshes as a user meets them: what is said about them, and that the origin
// travels along.
#include <algorithm>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Geometry : public ToolTest {
  protected:
    // Two poses of a sheet of two triangles at x = 1e6, with a face that is there twice, one on its
    // back, one without area in the second pose only, one on the first by vertices of its own, and
    // a stray vertex.
    void write_odd_poses() const {
        std::filesystem::create_directory(directory_ / "odd");
        const std::string faces = "f 1 2 3\nf 1 3 4\nf 2 3 1\nf 4 3 1\nf 1 2 5\nf 6 7 8\n";
        const std::string start =
            "v 1000000.1 0 0\nv 1000001.1 0 0\nv 1000001.1 1 0\nv 1000000.1 1 0\n";
        const std::string end = "v 1000000.1 0 0\nv 1000001.1 0 0\nv 1000001.1 1 0\nv 9 9 9\n";
        write("odd/0.obj", start + "v 1000000.6 0 -1\n" + end + faces);
        write("odd/1.obj", start + "v 1000000.6 0 0\n" + end + faces);
    }
};

TEST_F(Geometry, OddMeshesAreCountedAndExplained) {
    write_odd_poses();
    const Arguments bake{"bake", path("odd"), "-o", path("x.bake"), "--rays", "2", "--bands", "1"};
    const ToolResult first = compress(bake);
    expect_success(first);
    for (
        const char* line : {
            "warning: mesh: 1 vertices belong to no face: they stay in the file, without transfer and at "
            "one place, and count for nothing\n",
            "warning: mesh: 1 faces have the vertices of an earlier one: ",
            "warning: mesh: 1 faces are the back of an earlier one, with its vertices: ",
            "warning: mesh: 8 edges belong to one face: open sheets are lit on their front side "
            "only",
            "warning: mesh: 1 edges join two faces that face opposite sides: ",
            "warning: mesh: 1 faces (over all poses) have no area: ",
            "warning: mesh: 2 faces (over all poses) lie exactly on another: ",
        }) {
        EXPECT_TRUE(contains(first.err, line)) << line << " is not in: " << first.err;
    }
    EXPECT_FALSE(contains(first.err, "three or more"));

    // A bake that goes on knows what its poses were like.
    Arguments again = bake;
    again.push_back("--json");
    const auto json = parse_object(compress(again));
    EXPECT_EQ(json["poses_resumed"], 2);
    const nlohmann::json expected{
        {"isolated_vertices", 1}, {"duplicate_faces", 1},  {"back_faces", 1},
        {"boundary_edges", 8},    {"flipped_edges", 1},    {"non_manifold_edges", 0},
        {"zero_area_faces", 1},   {"coincident_faces", 2}, {"inward_parts", 0},
    };
    EXPECT_EQ(json["mesh"], expected);
}

// Nothing shadows a triangle, so that all its vertices have the same transfer.
TEST_F(Geometry, OneTriangleMeetsATargetWithEveryCodec) {
    std::filesystem::create_directory(directory_ / "t");
    write("t/0.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_success(
        compress({"bake", path("t"), "-o", path("t.bake"), "--rays", "16", "--bands", "10"}));
    for (const char* codec : {"auto", "svd", "cpca"}) {
        expect_success(compress({"encode", path("t.bake"), "-o", path("t.paim"), "--max-error",
                                 "10%", "--codec", codec}));
        expect_success(info({path("t.paim")}));
    }
}

TEST_F(Geometry, PartsThatFaceInwardsAreNamedAndTurned) {
    std::filesystem::create_directory(directory_ / "t");
    // Two tetrahedra; the second faces inwards.
    write("t/0.obj",
          "o good\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
          "o bad one\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 6 7\nf 5 8 6\nf 5 7 8\nf 6 8 7\n");
    Arguments bake{"bake", path("t"), "-o", path("in.bake"), "--rays", "2", "--bands", "1"};
    ToolResult result = compress(bake);
    expect_success(result);
    EXPECT_TRUE(contains(result.err,
                         "0.obj: the part with vertex 5 in 'bad one' is closed (4 triangles) and "
                         "faces inwards: --orient turns it"))
        << result.err;
    bake[3] = path("out.bake");
    bake.insert(bake.end(), {"--orient", "--json"});
    result = compress(bake);
    expect_success(result);
    EXPECT_TRUE(contains(result.err, "faces inwards: turned\n")) << result.err;
    const auto json = parse_object(result);
    EXPECT_EQ(json["mesh"]["inward_parts"], 1);
    EXPECT_EQ(json["rays_blocked"], 0);
}

TEST_F(Geometry, NothingIsSaidOfCleanMeshes) {
    const std::string sphere = make_poses("sphere", 1, 50);
    const ToolResult result =
        compress({"bake", sphere, "-o", path("x.bake"), "--rays", "2", "--json", "--quiet"});
    EXPECT_EQ(result.err, "");
    for (const auto& [kind, count] : parse_object(result)["mesh"].items()) {
        EXPECT_EQ(count, 0) << kind;
    }
}

TEST_F(Geometry, OddStillMeshesAreCountedByFile) {
    const std::string sphere = make_poses("sphere", 2, 50);
    const std::string whole = make_poses("box", 1, 50) + "/box_0000.obj";
    // A sheet of two triangles: one is there twice; one without area, one on another, a stray
    // point.
    write("odd.obj",
          "v 9 0 0\nv 10 0 0\nv 10 1 0\nv 9 1 0\nv 11 0 0\nv 9 0 0\nv 10 0 0\nv 10 1 0\nv 9 9 9\n"
          "f 1 2 3\nf 1 3 4\nf 2 3 1\nf 1 2 5\nf 6 7 8\n");
    const std::string odd = path("odd.obj");
    const Arguments bake{"bake", sphere,     "-o", path("x.bake"), "--rays", "2", "--static",
                         whole,  "--static", odd,  "--json"};
    const ToolResult first = compress(bake);
    for (const char* line : {
             ": 1 vertices belong to no face: they stay in the file, without transfer and at "
             "one place, and count for nothing\n",
             ": 1 faces have the vertices of an earlier one: ",
             ": 8 edges belong to one face: ",
             ": 1 edges join two faces that face opposite sides: ",
             ": 1 faces have no area: ",
             ": 1 faces lie exactly on another: ",
         }) {
        EXPECT_TRUE(contains(first.err, "warning: " + odd + line))
            << line << " is not in: " << first.err;
    }
    EXPECT_EQ(std::count(first.err.begin(), first.err.end(), '\n'), 6) << first.err;
    // The poses' own counts stay theirs; a bake that goes on says it all again.
    for (const ToolResult& result : {first, compress(bake)}) {
        const auto json = parse_object(result);
        for (const auto& [kind, count] : json["mesh"].items()) EXPECT_EQ(count, 0) << kind;
        nlohmann::json none = json["mesh"];
        none["file"] = whole;
        const nlohmann::json counts{
            {"file", odd},          {"isolated_vertices", 1},  {"duplicate_faces", 1},
            {"back_faces", 0},      {"boundary_edges", 8},     {"flipped_edges", 1},
            {"zero_area_faces", 1}, {"non_manifold_edges", 0}, {"coincident_faces", 1},
            {"inward_parts", 0},
        };
        EXPECT_EQ(json["static_mesh"], nlohmann::json::array({none, counts}));
    }
}

TEST_F(Geometry, TheOriginTravelsFromFilesToThePaim) {
    write_odd_poses();
    expect_success(compress({path("odd"), "-o", path("x.paim"), "--rays", "2", "--bands", "1"}));
    // Bounds 1000000.1 … 1000001.1, 0 … 1, -1 … 0: diagonal 1.7, so the centre rounded to whole
    // numbers.
    for (const char* file : {"x.bake", "x.paim"}) {
        const ToolResult text = info({path(file)});
        expect_success(text);
        EXPECT_TRUE(contains(text.out, "origin: 1000001 1 -1\n")) << text.out;
        EXPECT_EQ(parse_object(info({path(file), "--json"}))["origin"],
                  (std::vector<double>{1000001, 1, -1}));
    }
    // Zero where single precision is enough.
    expect_success(compress({make_poses("sphere", 1, 50), "-o", path("near.paim"), "--rays", "2"}));
    EXPECT_TRUE(contains(info({path("near.paim")}).out, "origin: 0 0 0\n"));
}

}  // namespace
}  // namespace paim
