// Arguments to files: patterns, folders, order, duplicates, nothing there.
#include "compressor/io/obj_files.h"

#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

namespace fs = std::filesystem;

class FindObjFiles : public testing::Test {
  protected:
    FindObjFiles() {
        for (const char* name : {"x_10.obj", "x_2.obj", "x_1.OBJ", "x_1.mtl", "odd[1].obj"}) {
            write_file(directory_ / name, "");
        }
        fs::create_directory(directory_ / "empty");
        fs::create_directory(directory_ / "folder.obj");
    }
    // The names found, in order, separated by spaces.
    std::string find(std::vector<std::string> arguments, bool keep_order = false) const {
        for (std::string& argument : arguments) argument = (directory_ / argument).string();
        std::string names;
        for (const fs::path& path : find_obj_files(arguments, keep_order)) {
            if (!names.empty()) names += ' ';
            names += path.filename().string();
        }
        return names;
    }
    std::string error(const std::string& argument) const {
        const std::string message =
            bad_input_of([&] { find_obj_files({(directory_ / argument).string()}, false); });
        const size_t at = message.find(directory_.path().string() + "/");
        return at == 0 ? message.substr(directory_.path().string().size() + 1) : message;
    }
    TemporaryDirectory directory_;
};

TEST_F(FindObjFiles, SortsNaturally) {
    EXPECT_EQ(find({"x_10.obj", "x_2.obj"}), "x_2.obj x_10.obj");
    EXPECT_EQ(find({"x_*"}), "x_1.OBJ x_2.obj x_10.obj");
    EXPECT_EQ(find({""}), "odd[1].obj x_1.OBJ x_2.obj x_10.obj");
    EXPECT_EQ(find({"x_[12]*.obj"}), "x_2.obj x_10.obj");
}

TEST_F(FindObjFiles, KeepsTheOrderOfArguments) {
    EXPECT_EQ(find({"x_10.obj", "x_2.obj"}, true), "x_10.obj x_2.obj");
    EXPECT_EQ(find({"x_10.obj", "x_?.*"}, true), "x_10.obj x_1.OBJ x_2.obj");
}

TEST_F(FindObjFiles, TakesEachFileOnceUnlessOrderIsKept) {
    EXPECT_EQ(find({"x_2.obj", "x_*.obj", "empty/../x_2.obj"}), "x_2.obj x_10.obj");
    EXPECT_EQ(find({"x_2.obj", "x_2.obj"}, true), "x_2.obj x_2.obj");
}

TEST_F(FindObjFiles, TakesNamesAsTheyAre) {
    EXPECT_EQ(find({"odd[1].obj"}), "odd[1].obj");
    EXPECT_EQ(find({"x_1.mtl"}), "x_1.mtl");
    EXPECT_EQ(find({"missing.obj"}), "missing.obj");  // opening it tells
}

TEST_F(FindObjFiles, PassesOverHiddenFiles) {
    for (const char* name : {"._x_2.obj", ".x.obj"}) write_file(directory_ / name, "");
    EXPECT_EQ(find({""}), "odd[1].obj x_1.OBJ x_2.obj x_10.obj");
    EXPECT_EQ(find({"*2.obj"}), "x_2.obj");
    EXPECT_EQ(find({"*.obj"}), "odd[1].obj x_2.obj x_10.obj");
    // Unless they are meant.
    EXPECT_EQ(find({".*.obj"}), "._x_2.obj .x.obj");
    EXPECT_EQ(find({".x.obj"}), ".x.obj");
    fs::create_directory(directory_ / "hidden");
    write_file(directory_ / "hidden/.a.obj", "");
    EXPECT_EQ(error("hidden"), "hidden: no OBJ files in this directory but 1 hidden ones (.*.obj)");
}

TEST_F(FindObjFiles, NotesGapsInWhatItSorts) {
    const auto notes_of = [&](std::vector<std::string> arguments, bool keep_order) {
        for (std::string& argument : arguments) argument = (directory_ / argument).string();
        std::vector<std::string> notes;
        find_obj_files(arguments, keep_order, &notes);
        return notes.size();
    };
    for (const char* name : {"g_1.obj", "g_2.obj", "g_5.obj"}) write_file(directory_ / name, "");
    EXPECT_EQ(notes_of({"g_1.obj", "g_2.obj", "g_5.obj"}, false), 1u);
    EXPECT_EQ(notes_of({"g_*.obj"}, true), 1u);
    EXPECT_EQ(notes_of({"g_1.obj", "g_2.obj", "g_5.obj"}, true), 0u);
    EXPECT_EQ(notes_of({"g_1.obj", "g_2.obj"}, false), 0u);
}

TEST_F(FindObjFiles, NamesWhatHasNone) {
    EXPECT_EQ(error("y_*.obj"), "y_*.obj: no OBJ files match this pattern");
    EXPECT_EQ(error("x_1.m*"), "x_1.m*: no OBJ files match this pattern");
    EXPECT_EQ(error("empty"), "empty: no OBJ files in this directory");
    EXPECT_EQ(bad_input_of([] { find_obj_files({}, false); }),
              "no OBJ files: expected at least one");
}

}  // namespace
}  // namespace paim
