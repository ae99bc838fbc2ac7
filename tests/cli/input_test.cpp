// OBJ files as exporters write them, through paim-compress: names of frames, materials, polygons
// that appear, vertex colours.
#include "paim/format/bake/bake_directory.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class Input : public ToolTest {
  protected:
    ToolResult bake(const std::string& input, const Arguments& options = {}) {
        name_ = path("bake" + std::to_string(num_bakes_++) + ".bake");
        Arguments arguments{"bake", input, "-o", name_, "--rays", "2", "--bands", "1", "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        ToolResult result = compress(arguments);
        expect_success(result);
        return result;
    }
    BakeReader reader() const { return BakeReader(name_); }

    // Writes triangles of these names into the folder, each unlike the others.
    std::string write_folder(const std::string& folder, const Arguments& names) const {
        std::filesystem::create_directory(path(folder));
        int i = 0;
        for (const std::string& name : names) {
            write(folder + "/" + name,
                  "v 0 0 0\nv 1 0 0\nv 0 1 " + std::to_string(++i) + "\nf 1 2 3\n");
        }
        return path(folder);
    }
    // The names of the poses of the last bake, without their folders.
    Arguments poses() const {
        Arguments names;
        const BakeReader bake = reader();
        for (const BakeIdentity::Source& pose : bake.identity().poses) {
            names.push_back(std::filesystem::path(pose.name).filename().string());
        }
        return names;
    }

  private:
    std::string name_;
    int num_bakes_ = 0;
};

TEST_F(Input, FramesComeInTheOrderOfTheirNumbers) {
    const std::vector<Arguments> orders{
        {"t-004.obj", "t-003.obj", "t-001.obj", "t0000.obj", "t0001.obj"},
        {"t.1.obj", "t.1.25.obj", "t.1.5.obj", "t.1.75.obj", "t.2.obj"},
        {"walk-01.obj", "walk-02.obj", "walk-10.obj"},
        {"shot-2-frame-9.obj", "shot-2-frame-10.obj"},
    };
    for (size_t i = 0; i < orders.size(); ++i) {
        const std::string folder = write_folder("order" + std::to_string(i), orders[i]);
        bake(folder);
        EXPECT_EQ(poses(), orders[i]);
        bake(folder + "/*.obj");
        EXPECT_EQ(poses(), orders[i]);
    }
}

TEST_F(Input, GapsAndDoublesAreNoted) {
    const std::string folder =
        write_folder("gap", {"t_0001.obj", "t_0002.obj", "t_0006.obj", "t_2.obj"});
    const std::string gap =
        "note: " + folder + "/t_0001.obj to t_0006.obj: frames 3 to 5 are missing\n";
    const std::string twice = "note: " + folder + "/t_2.obj: frame 2 is also in t_0002.obj\n";
    ToolResult result = bake(folder);
    EXPECT_TRUE(contains(result.err, gap + twice)) << result.err;
    result = bake(folder, {"--json"});
    EXPECT_TRUE(contains(result.err, gap)) << result.err;
    parse_object(result);
    result = bake(write_folder("whole", {"t_0001.obj", "t_0002.obj"}));
    EXPECT_FALSE(contains(result.err, "note: ")) << result.err;
}

TEST_F(Input, HiddenFilesAreNoPoses) {
    const std::string folder = write_folder("hidden", {"f_1.obj", "f_2.obj"});
    for (const char* name : {"._f_1.obj", "._f_2.OBJ", ".hidden.obj", ".DS_Store"}) {
        write(std::string("hidden/") + name, "not text\n");
    }
    for (const char* files : {"", "/", "/*", "/*.obj"}) {
        bake(folder + files);
        EXPECT_EQ(poses(), (Arguments{"f_1.obj", "f_2.obj"})) << files;
    }
}

TEST_F(Input, MaterialsHaveTheNamesThatExportersWrite) {
    write("my char.mtl", "newmtl skin\nKd 0.5 0 0\nnewmtl skin body\nKd 0 0.5 0\n");
    std::filesystem::create_directory(path("sub"));
    write("sub/x.mtl", "newmtl skin\nKd 0.5 0 0\nnewmtl skin body\nKd 0 0.5 0\n");
    for (const std::string library : {"my char.mtl", "sub\\x.mtl"}) {
        write("x.obj", "mtllib " + library + "\n" + kQuad +
                           "usemtl skin\nf 1 2 3\nusemtl skin body\nf 1 3 4\n");
        const ToolResult result = bake(path("x.obj"));
        EXPECT_FALSE(contains(result.err, "material")) << result.err;
        const std::vector<Vec3f> albedo = reader().albedo().values;
        ASSERT_EQ(albedo.size(), 4u);
        EXPECT_EQ(albedo[1], Vec3f(0.5f, 0, 0));
        EXPECT_EQ(albedo[3], Vec3f(0, 0.5f, 0));
    }
    write("x.obj", "mtllib no char.mtl\nusemtl skin\n" + kQuad + "f 1 2 3 4\n");
    const std::string missing = path("no char.mtl") + ": cannot open: No such file or directory\n";
    EXPECT_TRUE(contains(bake(path("x.obj")).err, "warning: " + missing));
}

TEST_F(Input, PolygonsThatAppearAreCutWhereTheyHaveArea) {
    const auto pose = [](const char* name, double s) {
        std::string text;
        for (const auto& [x, y] : std::vector<std::pair<double, double>>{
                 {1, 0}, {1, 0.3}, {0.3, 0.3}, {0.3, 1}, {0, 1}, {0, 0}}) {
            text += "v " + std::to_string(s * x) + " " + std::to_string(s * y) + " 0\n";
        }
        // Something that has area in every pose.
        return std::pair(name, text + "v 5 5 0\nv 6 5 0\nv 5 6 0\nf 7 8 9\nf 1 2 3 4 5 6\n");
    };
    std::filesystem::create_directory(path("pop"));
    for (const auto& [name, text] :
         {pose("pop/p_1.obj", 0), pose("pop/p_2.obj", 0.5), pose("pop/p_3.obj", 1)}) {
        write(name, text);
    }
    bake(path("pop"));
    const std::vector<Triangle> triangles = reader().topology().triangles;
    ASSERT_EQ(triangles.size(), 5u);
    const std::vector<float> positions = reader().read_pose(2).positions;  // all x, all y, all z
    for (const Triangle& t : triangles) {
        const auto edge = [&](int i, size_t axis) {
            return positions[9 * axis + t[i]] - positions[9 * axis + t[0]];
        };
        EXPECT_GT(edge(1, 0) * edge(2, 1) - edge(1, 1) * edge(2, 0), 0.0f);
    }
}

TEST_F(Input, VertexColoursAreTakenAsTheHeaderOrTheOptionSays) {
    const std::string mesh =
        "v 0 0 0 0.7354 0.7354 0.7354\nv 1 0 0 0.7354 0.7354 0.7354\nv 0 1 0 0.7354 0.7354 0.7354\n"
        "f 1 2 3\n";
    write("plain.obj", mesh);
    write("blender.obj", "# Blender 3.6.2\n# www.blender.org\n" + mesh);
    const auto albedo = [&] { return reader().albedo().values[0].x(); };

    ToolResult result = bake(path("plain.obj"));
    EXPECT_TRUE(contains(result.out,
                         "vertex colours are taken as linear; if they are not: "
                         "--vertex-colours srgb\n"))
        << result.out;
    EXPECT_EQ(albedo(), 0.7354f);
    result = bake(path("blender.obj"), {"--static", path("plain.obj")});
    EXPECT_TRUE(contains(result.out,
                         "  vertex colours are taken as sRGB, as Blender 3.6.2 writes "
                         "them\n  vertex colours of " +
                             path("plain.obj") + " are taken as linear; "))
        << result.out;
    EXPECT_NEAR(albedo(), 0.5f, 1e-4f);
    result = bake(path("plain.obj"), {"--vertex-colours", "srgb", "--json"});
    EXPECT_EQ(parse_object(result)["vertex_colours"], "srgb");
    EXPECT_NEAR(albedo(), 0.5f, 1e-4f);
    result = bake(path("blender.obj"), {"--vertex-colours", "linear"});
    EXPECT_TRUE(contains(result.out, "  vertex colours are taken as linear\n")) << result.out;
    EXPECT_EQ(albedo(), 0.7354f);
    result = bake(path("blender.obj"), {"--albedo", "0.2", "--json"});
    EXPECT_FALSE(parse_object(result).contains("vertex_colours"));
    expect_failure(
        compress({"bake", path("plain.obj"), "-o", path("x.bake"), "--vertex-colours", "rgb"}), 1,
        {"--vertex-colours", "auto", "linear", "srgb"});
}

// Each file has a header of its own.
TEST_F(Input, VertexColoursOfStillMeshesAreTakenAsTheirHeadersSay) {
    const std::string mesh =
        "v 0 0 0 0.7354 0.7354 0.7354\nv 1 0 0 0.7354 0.7354 0.7354\nv 0 1 0 0.7354 0.7354 0.7354\n"
        "f 1 2 3\n";
    write("plain.obj", mesh);
    write("meshlab.obj", "####\n#\n# OBJ File Generated by Meshlab\n#\n####\n" + mesh);
    write("old.obj", "# Blender v2.93.5 OBJ File: 'x.blend'\n# www.blender.org\n" + mesh);
    for (const char* const name : {"meshlab.obj", "old.obj"}) {
        const ToolResult result = bake(path("plain.obj"), {"--static", path(name)});
        EXPECT_TRUE(contains(result.out, "vertex colours of " + path(name) + " are taken as sRGB"))
            << result.out;
        EXPECT_EQ(reader().albedo().at(0).x(), 0.7354f);
        EXPECT_NEAR(reader().still_mesh()->albedo.at(0).x(), 0.5f, 1e-4f) << name;
    }
}

}  // namespace
}  // namespace paim
