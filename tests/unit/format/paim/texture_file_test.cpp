// Textures in .paim files: round trips, what old files keep, files that are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/container/texture_sections.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

using FileBytes = std::vector<char>;

// Of a mesh of four faces: images on three of them, numbers of coordinates in no order.
Texture example_texture() {
    Texture texture;
    texture.images = {{"skin \xc3\xbc.png", {1, 2, 3}}, {"", {}}, {"b.jpg", {255, 0}}};
    texture.factors = {Vec3f(1, 0.5f, 0), Vec3f(0, 0, 0), Vec3f(1, 1, 1)};
    texture.coordinates = {Vec2f(0, 0), Vec2f(1e30f, -2), Vec2f(0.25f, 0.5f), Vec2f(1, 1)};
    texture.image_of_face = {1, 0, 3, 2};
    texture.corners = {{3, 0, 2}, {0, 0, 0}, {1, 1, 3}, {2, 0, 1}};
    return texture;
}

// With a still part, which has a texture of its own.
Asset textured_example(bool packed) {
    Asset asset = packed ? make_packed_example(false) : make_example_asset();
    asset.moving().texture = example_texture();
    CodedMesh still;
    still.topology = asset.moving().topology;
    still.layout = asset.moving().layout;
    still.positions = LowRank::still(3, std::vector<float>(12, 0.5f));
    still.transfer = SvdTransfer(LowRank::still(
        still.layout.num_planes(), std::vector<float>(4 * still.layout.num_planes(), 0.25f)));
    still.texture = example_texture();
    still.texture.images[0].name = "still.png";
    asset.parts.push_back(std::move(still));
    return asset;
}

// The corners of a face by its vertices; packed files may rotate both.
std::vector<std::pair<uint32_t, uint32_t>> corners_of(const CodedMesh& mesh, size_t face) {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t k = 0; k < 3; ++k) {
        pairs.emplace_back(mesh.topology.triangles[face][k], mesh.texture.corners[face][k]);
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

class TextureFile : public testing::Test {
  protected:
    std::filesystem::path path() const { return directory_ / "x.paim"; }

    // The message of reading the file with one section changed.
    std::string refusal(Tag tag, const std::function<void(SectionSpec&, FileBytes&)>& change) {
        write_paim(path(), textured_example(false));
        const FileBytes whole = read_file(path(), 1 << 20);
        const ContainerReader reader(path(), section::kKindAnimation);
        std::vector<SectionPlan> plans;
        std::vector<FileBytes> contents;
        bool found = false;
        for (const Section& section : reader.sections()) {
            const auto first = whole.begin() + static_cast<ptrdiff_t>(section.offset);
            FileBytes bytes(first, first + static_cast<ptrdiff_t>(section.stored_size_bytes));
            SectionSpec spec = section.spec;
            if (spec.tag == tag && !found) {
                found = true;
                change(spec, bytes);
                if (bytes.empty() && spec.num_values() == 1) continue;  // left out
            }
            plans.emplace_back(spec);
            contents.push_back(std::move(bytes));
        }
        EXPECT_TRUE(found);
        ContainerWriter writer(path(), section::kKindAnimation, plans);
        for (size_t j = 0; j < plans.size(); ++j) {
            writer.append(j, contents[j].data(), contents[j].size());
        }
        writer.commit();
        try {
            read_paim(path());
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            return error.what();
        }
        return "no error";
    }

    void expect_refusal(const std::string& message, const std::string& part) const {
        EXPECT_NE(message.find(part), std::string::npos) << message;
    }

    TemporaryDirectory directory_;
};

// Writes a number into the bytes of a section.
template <typename Number>
std::function<void(SectionSpec&, FileBytes&)> with_number(size_t index, Number number) {
    return [=](SectionSpec&, FileBytes& bytes) {
        std::memcpy(bytes.data() + index * sizeof number, &number, sizeof number);
    };
}

// Drops the last row of a section of rows of so many bytes.
std::function<void(SectionSpec&, FileBytes&)> without_last(int dimension, size_t row_bytes) {
    return [=](SectionSpec& spec, FileBytes& bytes) {
        --spec.shape[static_cast<size_t>(dimension)];
        bytes.resize(bytes.size() - row_bytes);
    };
}

TEST_F(TextureFile, ComesBackAsItWas) {
    for (const bool packed : {false, true}) {
        const Asset asset = textured_example(packed);
        write_paim(path(), asset);
        EXPECT_EQ(paim_size_bytes(asset), std::filesystem::file_size(path()));
        const Asset read = read_paim(path());
        ASSERT_EQ(read.parts.size(), 2u);
        for (size_t part = 0; part < 2; ++part) {
            const Texture& expected = asset.parts[part].texture;
            const Texture& got = read.parts[part].texture;
            EXPECT_EQ(got.images, expected.images);
            EXPECT_EQ(got.factors, expected.factors);
            EXPECT_EQ(got.coordinates, expected.coordinates);
            EXPECT_EQ(got.image_of_face, expected.image_of_face);
            for (size_t f = 0; f < 4; ++f) {
                EXPECT_EQ(corners_of(read.parts[part], f), corners_of(asset.parts[part], f)) << f;
            }
            if (!packed) {
                EXPECT_EQ(got.corners, expected.corners);
            }
        }
    }
}

// Triangles of packed files come back rotated, if only some.
TEST_F(TextureFile, CornersGoWithRotatedTriangles) {
    Asset asset = make_packed_example(false);
    asset.moving().texture = example_texture();
    for (Triangle& t : asset.moving().topology.triangles) t = {t[1], t[2], t[0]};
    write_paim(path(), asset);
    const Asset read = read_paim(path());
    EXPECT_NE(read.moving().topology.triangles, asset.moving().topology.triangles);
    for (size_t f = 0; f < 4; ++f)
        EXPECT_EQ(corners_of(read.moving(), f), corners_of(asset.moving(), f));
}

TEST_F(TextureFile, FilesWithoutTexturesHaveNoSectionOfThem) {
    write_paim(path(), make_example_asset());
    const ContainerReader reader(path(), section::kKindAnimation);
    for (const Section& section : reader.sections()) {
        EXPECT_FALSE(section.spec.tag.str().starts_with("TX")) << section.spec.tag.str();
    }
    EXPECT_TRUE(read_paim(path()).moving().texture == Texture());
}

TEST_F(TextureFile, DifferencesOfCornersComeBack) {
    constexpr uint32_t kMost = 0xffffffff;
    for (const uint32_t a : {0u, 1u, 5u, 0x7fffffffu, 0x80000000u, 0x80000001u, kMost - 1, kMost}) {
        for (const uint32_t b : {0u, 1u, 7u, 0x7fffffffu, 0x80000000u, kMost}) {
            EXPECT_EQ(corner_after(a, corner_difference(b, a)), b);
        }
    }
    EXPECT_EQ(corner_difference(5, 5), 0u);
    EXPECT_EQ(corner_difference(4, 5), 1u);
    EXPECT_EQ(corner_difference(6, 5), 2u);
}

TEST_F(TextureFile, RefusesNumbersThatDoNotExist) {
    const section::TextureTags& tags = section::kTexture[0];
    expect_refusal(refusal(tags.of_face, with_number(0, uint32_t{4})), "image 4 of a face");
    expect_refusal(refusal(tags.of_face, with_number(3, uint32_t{0xffffffff})),
                   "image 4294967295 of a face, expected 0 to 3");
    // The first corner: 4 − 0, and −1.
    expect_refusal(refusal(tags.corners, with_number(0, uint32_t{8})),
                   "coordinate 4 of triangle 0, expected 0 to 3");
    expect_refusal(refusal(tags.corners, with_number(0, uint32_t{1})),
                   "coordinate 4294967295 of triangle 0");
    expect_refusal(refusal(tags.coordinates, with_number(1, std::nanf(""))), "expected a finite");
    expect_refusal(refusal(tags.factors, with_number(0, 1.5f)), "expected numbers from 0 to 1");
    expect_refusal(refusal(tags.factors, with_number(0, -0.5f)), "expected numbers from 0 to 1");
    expect_refusal(refusal(tags.names, with_number(0, '\0')), "4 entries, expected 3");
    EXPECT_EQ(refusal(tags.names, with_number(1, 'x')), "no error");
}

TEST_F(TextureFile, RefusesOtherShapes) {
    const section::TextureTags& tags = section::kTexture[0];
    expect_refusal(refusal(tags.of_face, without_last(2, 4)), "3 entries, expected 4");
    expect_refusal(refusal(tags.corners, without_last(1, 12)), "3 entries, expected 4");
    expect_refusal(refusal(tags.factors, without_last(1, 12)), "3 entries, expected 2");
    expect_refusal(refusal(tags.names, without_last(2, 1)), "entries, expected 3");
    expect_refusal(refusal(tags.coordinates, without_last(1, 8)), "coordinate 3 of triangle 0");
    expect_refusal(refusal(tags.coordinates,
                           [](SectionSpec& spec, FileBytes&) {
                               spec.shape = {1, 2, 4};
                           }),
                   "1 x 2 x 4 values, expected 2 in a row");
    expect_refusal(refusal(tags.coordinates,
                           [](SectionSpec& spec, FileBytes& bytes) {
                               spec.shape = {1, 0, 2};
                               bytes.clear();
                           }),
                   "0 texture coordinates, expected at least 1");
    expect_refusal(refusal(tags.factors,
                           [](SectionSpec& spec, FileBytes& bytes) {
                               spec.shape = {1, 0, 3};
                               bytes.clear();
                           }),
                   "0 images, expected 1 to 65535");
    for (const Tag tag :
         {tags.names, tags.image, tags.coordinates, tags.corners, tags.of_face, tags.factors}) {
        const std::string message = refusal(tag, [](SectionSpec& spec, FileBytes& bytes) {
            spec.shape = {1, 1, 1};
            bytes.clear();
        });
        expect_refusal(message, tag.str() + " 0 is missing");
    }
    expect_refusal(
        refusal(tags.of_face, [](SectionSpec& spec, FileBytes&) { spec.type = ScalarType::f32; }),
        "holds f32, expected u32");
}

}  // namespace
}  // namespace paim
