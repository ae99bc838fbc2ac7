// Real files: six captured or simulated sequences, and a parser's collection of odd models.
#include <map>
#include <ostream>

#include "compressor/io/obj_files.h"
#include "paim/mesh/normals.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

const std::filesystem::path kData = PAIM_UNPACKED_DATA_DIR;

struct Expected {
    const char* name;
    uint32_t num_poses, num_vertices;
    size_t num_triangles;
    size_t num_warnings;  // 1 where materials are named but there is no .mtl file
};

// Keeps addresses out of the names of tests.
void PrintTo(const Expected& expected, std::ostream* out) {
    *out << expected.name;
}

class RealSequence : public testing::TestWithParam<Expected> {};

TEST_P(RealSequence, OpensAndLoads) {
    const Expected expected = GetParam();
    const auto files = find_obj_files({(kData / expected.name / expected.name).string()}, false);
    const ObjSequence sequence(files);
    EXPECT_EQ(sequence.num_poses(), expected.num_poses);
    EXPECT_EQ(sequence.topology().num_vertices, expected.num_vertices);
    EXPECT_EQ(sequence.topology().triangles.size(), expected.num_triangles);
    EXPECT_EQ(sequence.warnings().size(), expected.num_warnings)
        << testing::PrintToString(sequence.warnings());
    for (const uint32_t p : {0u, expected.num_poses / 2, expected.num_poses - 1}) {
        const Pose pose = sequence.load_pose(p);
        ASSERT_EQ(pose.positions.size(), expected.num_vertices);
        for (const Vec3f& normal : pose.normals) {
            // Float rounding of a unit vector, 2^-24 an entry.
            EXPECT_TRUE(normal.isZero(0.0f) || std::abs(normal.norm() - 1.0f) < 2e-7f);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, RealSequence,
                         testing::Values(Expected{"horse-gallop", 48, 8431, 16843, 0},
                                         Expected{"wolf", 21, 5075, 10018, 0},
                                         Expected{"dembones_bone", 400, 754, 1504, 0},
                                         Expected{"knight_2h_spin", 73, 2454, 4712, 1},
                                         Expected{"robot_dance", 81, 1820, 3234, 1},
                                         Expected{"blender_flag", 90, 6305, 12288, 0}),
                         [](const auto& parameter) {
                             std::string name = parameter.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(RealNormals, AgreeWithComputedOnes) {
    ObjOptions options;
    options.normals_from_file = true;
    const ObjSequence sequence(
        find_obj_files({(kData / "blender_flag/blender_flag").string()}, false), options);
    for (const uint32_t p : {0u, 45u, 89u}) {
        const Pose pose = sequence.load_pose(p);
        const auto computed = vertex_normals(sequence.topology(), pose.positions);
        double sum = 0.0;
        for (size_t v = 0; v < computed.size(); ++v) sum += pose.normals[v].dot(computed[v]);
        // Both are averages over the same faces with other weights, of quads that are not planar;
        // on a smooth sheet the mean cosine is near one (0.988 here), and would be near zero if the
        // indices of another pose were used.
        EXPECT_GT(sum / computed.size(), 0.98) << p;
    }
}

// What the odd models give that are no meshes; all others must load.
TEST(OddModels, GiveAMeshOrAClearError) {
    const std::map<std::string, std::string> errors{
        {"invalid-face-definition.obj", ": no faces"},  // all of fewer than three corners
        {"invalid-relative-texture-index.obj",
         ":2: texture coordinate index -2 is out of range: expected -1 to -1"},
        {"invalid-relative-vertex-index.obj",
         ":1: face index -4 is out of range: none precedes this line"},
        {"issue-140-zero-face-idx.obj", ":16: face index 0 is out of range: expected 1 or more"},
        {"issue-356-leading-spaces-newmtl.obj", ": no vertices"},
        {"line-prim.obj", ": no faces"},
        {"points-prim.obj", ": no faces"},
        {"test-nan.obj", ":12: vertex coordinate: expected a finite number, got 'nan'"},
    };
    const auto files =
        find_obj_files({(kData / "obj-torture/tinyobjloader/models").string()}, false);
    size_t num_errors = 0;
    for (const auto& file : files) {
        const std::string message = bad_input_of([&] { ObjSequence({file}).load_pose(0); });
        const auto error = errors.find(file.filename().string());
        const bool expects_error = error != errors.end();
        EXPECT_EQ(message, expects_error ? file.string() + error->second : "no error");
        num_errors += expects_error;
    }
    EXPECT_EQ(num_errors, errors.size());
    EXPECT_GT(files.size(), 40u);
}

TEST(OddModels, AreReadAsMeant) {
    const auto open = [](const std::string& name) {
        return ObjSequence({kData / "obj-torture/tinyobjloader/models" / name});
    };
    EXPECT_EQ(open("cube-vertexcol.obj").albedo().values[4], Vec3f(1, 0, 0));
    EXPECT_EQ(open("cube-vertex-w-component.obj").topology().triangles.size(), 12u);
    // Polygons up to a decagon, with vertices in the middle of edges.
    EXPECT_EQ(open("issue-319-002.obj").topology().triangles.size(), 5u + 6u + 3u);
    EXPECT_EQ(open("issue-319-003.obj").topology().triangles.size(), 8u);
    EXPECT_EQ(open("mtl filename with whitespace issue46.obj").albedo().values,
              (std::vector<Vec3f>{{0, 1, 0}}));
    EXPECT_EQ(open("leading-decimal-dot-issue-201.obj").load_pose(0).positions[0],
              Vec3f(0.08f, -70.0f, -5.532511f));
    // A cube of six quads of several materials: two sides red and green, the rest white.
    EXPECT_EQ(open("cube.obj").albedo().values.size(), 8u);
}

}  // namespace
}  // namespace paim
