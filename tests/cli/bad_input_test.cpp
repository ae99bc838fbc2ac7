// What cannot be read or written: the exit code, a message that says what, where, expected and got,
// and nothing left behind.
#include <cmath>
#include <utility>

#include "paim/image/exr.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

const std::string kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

class BadInput : public ToolTest {
  protected:
    // Runs a tool that shall fail and leave everything as it was.
    void expect_refusal(const char* tool, const Arguments& arguments, int exit_code,
                        const Arguments& parts) const {
        const Contents before = contents_of(directory_.path());
        expect_failure(run(tool, arguments), exit_code, parts);
        expect_same(contents_of(directory_.path()), before);
    }

    // Both ways of baking these inputs.
    void expect_bake_refusal(const std::string& input, const Arguments& parts) const {
        expect_refusal(PAIM_COMPRESS, {input, "-o", path("out.paim")}, 2, parts);
        expect_refusal(PAIM_COMPRESS, {"bake", input, "-o", path("out.bake")}, 2, parts);
    }

    // All that read a .bake.
    void expect_no_reader_takes(const std::string& bake, const Arguments& parts) const {
        expect_refusal(PAIM_COMPRESS, {"encode", bake, "-o", path("out.paim")}, 2, parts);
        expect_refusal(PAIM_INFO, {bake}, 2, parts);
        expect_refusal(PAIM_ANALYZE, {bake, "-o", path("out"), "--size", "16"}, 2, parts);
    }

    // The tool with files limited to a kilobyte (POSIX counts blocks of 512 bytes).
    static ToolResult run_with_full_disk(Arguments arguments) {
        arguments.insert(arguments.begin(), {"/bin/sh", "-c", "ulimit -f 2; exec \"$0\" \"$@\""});
        return run_tool(arguments);
    }
};

TEST_F(BadInput, MissingAndEmptySequences) {
    expect_bake_refusal(path("nothing.obj"), {path("nothing.obj") + ": cannot open: No such file"});
    expect_bake_refusal(path("no*.obj"), {path("no*.obj") + ": no OBJ files match this pattern"});
    std::filesystem::create_directory(directory_ / "folder.paim");
    expect_bake_refusal(path("folder.paim"),
                        {path("folder.paim") + ": no OBJ files in this directory"});
    write("empty.obj", "");
    expect_bake_refusal(path("empty.obj"), {path("empty.obj") + ": no vertices"});
    write("points.obj", "v 0 0 0\nv 1 0 0\n");
    expect_bake_refusal(path("points.obj"), {path("points.obj") + ": no faces"});
}

TEST_F(BadInput, PosesThatDoNotFitOrMakeNoSense) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {replaced(kTetrahedron, "f 1 3 2", "v 1 1 1\nf 1 3 2"),
         ": 5 vertices, expected 4 (as in a.obj)"},
        {replaced(kTetrahedron, "f 3 1 4\n", ""), ": 3 faces, expected 4 (as in a.obj)"},
        {replaced(kTetrahedron, "f 2 3 4", "f 2 4 3"),
         ":7: face 3 is '2 4 3', expected '2 3 4' (as in a.obj)"},
        {replaced(kTetrahedron, "f 1 2 4", "f 1 2 9"),
         ":6: face index 9 is out of range: expected 1 to 4"},
        {replaced(kTetrahedron, "f 1 2 4", "f 1 2 -5"), ":6: face index -5 is out of range"},
        {replaced(kTetrahedron, "v 1 0 0", "v nan 0 0"),
         ":2: vertex coordinate: expected a finite number, got 'nan'"},
        {replaced(kTetrahedron, "v 1 0 0", "v 1 0"),
         ":2: vertex coordinate: expected 3 numbers, got 2"},
    };
    std::filesystem::create_directory(directory_ / "poses");
    write("poses/a.obj", kTetrahedron);
    for (const auto& [text, message] : cases) {
        write("poses/b.obj", text);
        expect_bake_refusal(path("poses"), {path("poses/b.obj") + message});
    }
}

TEST_F(BadInput, NormalsThatTheFilesDoNotHave) {
    write("a.obj", kTetrahedron);
    expect_refusal(PAIM_COMPRESS, {path("a.obj"), "-o", path("x.paim"), "--normals", "file"}, 2,
                   {path("a.obj"), "normal"});
}

TEST_F(BadInput, EnvironmentsThatAreNoPictures) {
    const std::string bake = make_bake("x.bake");
    expect_success(compress({"encode", bake, "-o", path("x.paim")}));
    write("text.exr", "this is not a picture");
    Image image(64, 32);
    for (size_t j = 0; j < image.pixels.size(); ++j) {
        image.pixels[j] = Vec3f::Constant(std::sin(static_cast<float>(j)) + 1.0f);
    }
    write_exr(directory_ / "whole.exr", image);
    const auto bytes = read_file(path("whole.exr"), 1 << 20);
    write("cut.exr",
          std::string(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(bytes.size() / 2)));
    for (const std::string name : {"missing.exr", "text.exr", "cut.exr"}) {
        const std::string env = path(name);
        expect_refusal(PAIM_ANALYZE, {bake, "-o", path("out"), "--size", "16", "--env", env}, 2,
                       {env + ": "});
#ifdef PAIM_PLAY
        expect_refusal(
            PAIM_PLAY,
            {path("x.paim"), "--env", env, "--snapshot", path("out.png"), "--size", "16x16"}, 2,
            {env + ": "});
#endif
    }
}

TEST_F(BadInput, FilesCutAtFiftyPlaces) {
    expect_success(compress({"encode", make_bake("x.bake"), "-o", path("x.paim")}));
    const auto whole = read_file(path("x.paim"), 1 << 20);
    for (size_t cut = 0; cut < 50; ++cut) {
        const size_t length = whole.size() * cut / 50;
        write_file(directory_ / "cut.paim", {whole.data(), length});
        expect_failure(info({path("cut.paim")}), 2,
                       {path("cut.paim") + ": " + std::to_string(length) + " bytes, expected "});
    }
}

TEST_F(BadInput, NeitherFileNorBake) {
    write("a.paim", std::string(1000, 'x'));
    expect_refusal(PAIM_INFO, {path("a.paim")}, 2, {path("a.paim") + ": not a Paim file"});
    expect_refusal(PAIM_INFO, {path("b.paim")}, 2, {path("b.paim") + ": cannot open"});
    std::filesystem::create_directory(directory_ / "folder.paim");
    expect_no_reader_takes(
        path("folder.paim"),
        {path("folder.paim") + ": expected a .bake directory, got one without manifest"});
    expect_refusal(PAIM_COMPRESS, {"encode", path("a.paim"), "-o", path("out.paim")}, 2,
                   {path("a.paim") + ": expected a .bake directory, got a file"});
    expect_refusal(PAIM_COMPRESS, {"encode", path("b.bake"), "-o", path("out.paim")}, 2,
                   {path("b.bake") + ": expected a .bake directory, got nothing of that name"});
}

TEST_F(BadInput, DamagedBakes) {
    const std::string bake = make_bake("x.bake");
    const Contents whole = contents_of(bake);
    const auto text_of = [&](const std::string& name) {
        return std::string(whole.at(name).begin(), whole.at(name).end());
    };
    const auto restore = [&](const std::string& name) { write("x.bake/" + name, text_of(name)); };

    std::filesystem::remove(bake + "/pose_000002.bin");
    expect_no_reader_takes(bake, {bake + ": 1 of 4 poses are missing, the first is 2"});
    restore("pose_000002.bin");

    std::string damaged = text_of("pose_000001.bin");
    damaged[damaged.size() / 2] ^= 1;
    write("x.bake/pose_000001.bin", damaged);
    expect_no_reader_takes(bake, {bake + "/pose_000001.bin: ", "checksum"});
    write("x.bake/pose_000001.bin", damaged.substr(0, damaged.size() / 2));
    expect_no_reader_takes(bake, {bake + "/pose_000001.bin: ", "cut short"});
    write("x.bake/pose_000001.bin", text_of("pose_000002.bin"));  // a pose in another's place
    expect_no_reader_takes(bake, {bake + "/pose_000001.bin: ", "'pose': expected 1 to 1, got 2"});
    restore("pose_000001.bin");

    damaged = text_of("manifest.json");
    write("x.bake/manifest.json", damaged.substr(0, damaged.size() / 2));
    expect_no_reader_takes(bake, {bake + "/manifest.json: ", "not a JSON object"});
    expect_refusal(PAIM_COMPRESS, {"bake", path("plates"), "-o", bake}, 2,
                   {bake + "/manifest.json: "});
    write("x.bake/manifest.json", replaced(damaged, "\"rays\": 16", "\"rays\": 18"));
    expect_no_reader_takes(bake, {bake + "/pose_000", ".bin: belongs to bake "});
    restore("manifest.json");

    damaged = text_of("mesh.bin");
    damaged[damaged.size() - 1] ^= 1;
    write("x.bake/mesh.bin", damaged);
    expect_no_reader_takes(bake, {bake + "/mesh.bin: "});
    restore("mesh.bin");
    expect_success(info({bake}));  // all is as it was
}

TEST_F(BadInput, PlacesThatCannotBeWritten) {
    const std::string bake = make_bake("x.bake");
    const std::string poses = path("plates");
    write("file", "in the way");
    std::filesystem::create_directory(directory_ / "folder.paim");
    for (const std::string& output : {path("missing/x.paim"), path("file/x.paim")}) {
        expect_refusal(PAIM_COMPRESS, {"encode", bake, "-o", output}, 4, {output + ": "});
        expect_refusal(PAIM_COMPRESS, {poses, "-o", output}, 4, {output + ": "});
    }
    expect_refusal(PAIM_COMPRESS, {"encode", bake, "-o", path("folder.paim")}, 4,
                   {path("folder.paim") + ": is a directory"});
    expect_refusal(PAIM_COMPRESS, {poses, "-o", path("folder.paim")}, 4,
                   {path("folder.paim") + ": is a directory"});
    for (const std::string& output : {path("missing/x.bake"), path("file/x.bake"), path("file")}) {
        expect_refusal(PAIM_COMPRESS, {"bake", poses, "-o", output}, 4, {output + ": "});
    }
    // Temporary names, which are longer, must fit into the 255 bytes of a name, too.
    const std::string long_name = path(std::string(230, 'x'));
    for (const char* const extension : {".paim", ".bake"}) {
        Arguments arguments{poses, "-o", long_name + extension};
        if (std::string(extension) == ".bake") arguments.insert(arguments.begin(), "bake");
        expect_refusal(PAIM_COMPRESS, arguments, 4, {"a name of 235 bytes, expected at most"});
    }
    for (const std::string& output : {path("file"), path("file/below")}) {
        expect_refusal(PAIM_ANALYZE, {bake, "-o", output, "--size", "16"}, 4, {output + ": "});
    }
}

TEST_F(BadInput, FullDisk) {
    const std::string bake = make_bake("x.bake");
    write("x.paim", "an earlier result");
    const Contents before = contents_of(directory_.path());
    expect_failure(run_with_full_disk({PAIM_COMPRESS, "encode", bake, "-o", path("x.paim")}), 4,
                   {path("x.paim") + ": cannot write: File too large"});
    expect_same(contents_of(directory_.path()), before);

    // A bake keeps what it has: the manifest fits, no pose does.
    expect_failure(run_with_full_disk({PAIM_COMPRESS, "bake", path("plates"), "-o", path("y.bake"),
                                       "--rays", "16", "--bands", "3"}),
                   4, {path("y.bake/pose_000000.bin") + ": cannot write: File too large"});
    for (const auto& [name, bytes] : contents_of(path("y.bake"))) {
        EXPECT_TRUE(name == "manifest.json" || name == "mesh.bin") << name;
    }
    expect_success(
        compress({"bake", path("plates"), "-o", path("y.bake"), "--rays", "16", "--bands", "3"}));
    expect_same(contents_of(path("y.bake")), contents_of(bake));
}

TEST_F(BadInput, ResultsThatStandardOutputCannotTake) {
    const std::string bake = make_bake("x.bake");
    for (const std::string redirection : {"> /dev/full", ">&-"}) {
        const ToolResult result = run_tool(
            {"/bin/sh", "-c", "exec \"$0\" \"$@\" " + redirection, PAIM_INFO, bake, "--json"});
        expect_failure(result, 4, {"cannot write"});
    }
}

}  // namespace
}  // namespace paim
