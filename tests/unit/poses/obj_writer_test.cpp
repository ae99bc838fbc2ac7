// OBJ text: floats survive, faces count from 1, names sort.
#include "poses/obj_writer.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "poses/octopus.h"

namespace paim::poses {
namespace {

TEST(ObjWriter, WritesWhatReadsBackAsTheSameFloats) {
    const auto octopus = make_octopus_sequence(1000);
    const auto positions = octopus->positions(1, 3);
    for (const bool colored : {false, true}) {
        std::istringstream text(ObjWriter("octopus", *octopus, colored).format(positions));
        std::string line;
        std::getline(text, line);
        EXPECT_EQ(line, "o octopus");
        size_t num_vertices = 0, num_faces = 0;
        while (std::getline(text, line)) {
            std::istringstream words(line);
            std::string kind, word;
            words >> kind;
            std::vector<std::string> values;
            while (words >> word) values.push_back(word);
            if (kind == "v") {
                ASSERT_EQ(values.size(), colored ? 6u : 3u);
                for (size_t i = 0; i < 3; ++i) {
                    EXPECT_EQ(std::stof(values[i]),
                              positions[num_vertices][static_cast<Eigen::Index>(i)]);
                }
                ++num_vertices;
            } else {
                ASSERT_EQ(kind, "f");
                ASSERT_EQ(values.size(), 3u);
                const Triangle& t = octopus->topology().triangles[num_faces++];
                for (size_t i = 0; i < 3; ++i) EXPECT_EQ(std::stoul(values[i]), t[i] + 1);
            }
        }
        EXPECT_EQ(num_vertices, 1000u);
        EXPECT_EQ(num_faces, octopus->topology().triangles.size());
    }
}

TEST(ObjFileName, HasAtLeastFourDigits) {
    EXPECT_EQ(obj_file_name("box", 7, 24), "box_0007.obj");
    EXPECT_EQ(obj_file_name("box", 7, 10'000), "box_0007.obj");
    EXPECT_EQ(obj_file_name("box", 7, 10'001), "box_00007.obj");
}

}  // namespace
}  // namespace paim::poses
