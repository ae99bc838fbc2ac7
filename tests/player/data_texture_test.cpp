// What textures hold after an upload, read back: every kind of value, over several blocks of rows.
#include "player/gl/data_texture.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "player/gl/check.h"
#include "player/gl/headless_context.h"

namespace paim::player::gl {
namespace {

// 1024 texels a row are sent 64 rows at a time: three blocks, of which the last is cut.
constexpr int kWidthLog2 = 10;
constexpr int64_t kTexels = 150'000;
constexpr size_t kRows = 147;

class DataTextureTest : public testing::Test {
  protected:
    // All rows of the texture, four or one values a texel. OpenGL ES cannot read textures back.
    template <typename Value>
    static std::vector<Value> read(const DataTexture& texture, GLenum format, GLenum type) {
        std::vector<Value> values(static_cast<size_t>(values_per_texel(texture.format())) * kRows
                                  << kWidthLog2);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glBindTexture(GL_TEXTURE_2D, texture.handle().id());
        glGetTexImage(GL_TEXTURE_2D, 0, format, type, values.data());
        check_errors("reading a texture");
        return values;
    }

    // Uploads a value for every place, and expects these and zeros in what is left of the last row.
    template <typename Value, typename Stored = Value>
    static void expect_round_trip(TexelFormat format, GLenum external, GLenum type,
                                  Value (*value_at)(int64_t)) {
        const DataTexture texture("the test", format, kWidthLog2, kTexels);
        const int per_texel = values_per_texel(format);
        texture.upload([&](int64_t first, std::span<Value> out) {
            for (size_t j = 0; j < out.size(); ++j) {
                out[j] = value_at(first * per_texel + static_cast<int64_t>(j));
            }
        });
        const auto values = read<Stored>(texture, external, type);
        for (size_t j = 0; j < values.size(); ++j) {
            const auto place = static_cast<int64_t>(j);
            const Value expected = place < kTexels * per_texel ? value_at(place) : Value{0};
            ASSERT_EQ(static_cast<Value>(values[j]), expected) << j;
        }
    }

    std::unique_ptr<Context> context_ = make_headless_context(Api::desktop);
};

TEST_F(DataTextureTest, KeepsEveryKindOfValue) {
    expect_round_trip<int8_t>(TexelFormat::rgba8i, GL_RGBA_INTEGER, GL_BYTE,
                              [](int64_t j) { return static_cast<int8_t>(j * 7 % 256 - 128); });
    const auto words = [](int64_t j) { return static_cast<int16_t>(j * 31 % 65536 - 32768); };
    expect_round_trip<int16_t>(TexelFormat::rgba16i, GL_RGBA_INTEGER, GL_SHORT, words);
    expect_round_trip<int16_t>(TexelFormat::r16i, GL_RED_INTEGER, GL_SHORT, words);
    const auto floats = [](int64_t j) { return static_cast<float>(j) * 0.1f; };
    expect_round_trip<float>(TexelFormat::rgba32f, GL_RGBA, GL_FLOAT, floats);
    expect_round_trip<float>(TexelFormat::rgb32f, GL_RGB, GL_FLOAT, floats);
    expect_round_trip<float>(TexelFormat::r32f, GL_RED, GL_FLOAT, floats);
    // Half floats hold whole numbers up to 2048.
    expect_round_trip<float, Eigen::half>(TexelFormat::rgba16f, GL_RGBA, GL_HALF_FLOAT,
                                          [](int64_t j) { return static_cast<float>(j % 2049); });
}

// Whole rows and a part of one; fewer than a row.
TEST_F(DataTextureTest, CopiesABuffer) {
    for (const int64_t num_texels : {kTexels, int64_t{700}}) {
        std::vector<float> values(3 * static_cast<size_t>(num_texels));
        for (size_t j = 0; j < values.size(); ++j) values[j] = static_cast<float>(j);
        const BufferHandle buffer;
        glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size() * sizeof(float)),
                     values.data(), GL_STATIC_DRAW);
        const DataTexture texture("the test", TexelFormat::rgb32f, kWidthLog2, num_texels);
        texture.copy(buffer);
        const auto held = read<float>(texture, GL_RGB, GL_FLOAT);
        for (size_t j = 0; j < values.size(); ++j) ASSERT_EQ(held[j], values[j]) << j;
        // Later uploads are from memory again.
        texture.upload([](int64_t, std::span<float> out) { std::ranges::fill(out, 5.0f); });
        EXPECT_EQ(read<float>(texture, GL_RGB, GL_FLOAT)[1], 5.0f);
    }
}

TEST_F(DataTextureTest, UpdatesTheFirstTexelsAlone) {
    const DataTexture texture("the test", TexelFormat::rgba32f, kWidthLog2, kTexels);
    texture.upload([](int64_t, std::span<float> out) { std::ranges::fill(out, 5.0f); });
    // Two rows and three texels.
    std::vector<float> values(4 * (2 * 1024 + 3));
    for (size_t j = 0; j < values.size(); ++j) values[j] = static_cast<float>(j);
    texture.update(values);
    const auto held = read<float>(texture, GL_RGBA, GL_FLOAT);
    for (size_t j = 0; j < 4 * size_t{kTexels}; ++j) {
        ASSERT_EQ(held[j], j < values.size() ? static_cast<float>(j) : 5.0f) << j;
    }
}

using DataTextureDeathTest = DataTextureTest;

TEST_F(DataTextureDeathTest, RefusesValuesOfAnotherKind) {
    const DataTexture texture("the test", TexelFormat::rgba8i, kWidthLog2, 4);
    EXPECT_DEATH(texture.upload([](int64_t, std::span<int16_t>) {}), "check failed");
    EXPECT_DEATH(texture.upload([](int64_t, std::span<float>) {}), "check failed");
    EXPECT_DEATH(texture.update(std::vector<float>(4)), "check failed");
}

}  // namespace
}  // namespace paim::player::gl
