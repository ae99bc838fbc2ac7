// Damaged EXR files: every truncation and every damaged byte of small files ends in a picture or an
// Error.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/seed.h"
#include "paim/image/exr.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

// Overwrites in place; AtomicFile would flush thousands of times.
void put(const std::filesystem::path& path, const std::vector<char>& bytes, size_t size_bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(size_bytes));
    ASSERT_TRUE(file.good());
}

std::vector<char> small_file(const TemporaryDirectory& directory) {
    Image image(7, 40);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = Vec3f::Constant(static_cast<float>(mix_bits(i) % 1000));
    }
    write_exr(directory / "good.exr", image);
    return read_file(directory / "good.exr", 1u << 20);
}

// True if it was read; false if refused as it should be.
bool try_read(const std::filesystem::path& path) {
    try {
        const Image image = read_exr(path, {4096, 4096});
        EXPECT_EQ(image.pixels.size(), static_cast<size_t>(image.width * image.height));
        return true;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_EQ(std::string(error.what()).find(path.string()), 0u) << error.what();
        return false;
    }
}

TEST(ExrDamage, EveryTruncationIsRefused) {
    const TemporaryDirectory directory;
    const std::vector<char> bytes = small_file(directory);
    for (size_t size = 0; size < bytes.size(); ++size) {
        put(directory / "a.exr", bytes, size);
        EXPECT_FALSE(try_read(directory / "a.exr")) << size << " of " << bytes.size();
    }
    put(directory / "a.exr", bytes, bytes.size());
    EXPECT_TRUE(try_read(directory / "a.exr"));
}

TEST(ExrDamage, EveryDamagedByteIsSurvived) {
    const TemporaryDirectory directory;
    const std::vector<char> bytes = small_file(directory);
    size_t num_refused = 0;
    for (size_t i = 0; i < bytes.size(); ++i) {
        for (const int mask : {0x01, 0x80, 0xff}) {
            std::vector<char> damaged = bytes;
            damaged[i] = static_cast<char>(damaged[i] ^ mask);
            put(directory / "a.exr", damaged, damaged.size());
            num_refused += try_read(directory / "a.exr") ? 0 : 1;
        }
    }
    // zlib's checksum sees damage in the pixels; what passes is in attributes that are not used.
    EXPECT_GT(num_refused, bytes.size() * 3 / 2);
}

TEST(ExrDamage, RefusesWhatIsNoExr) {
    const TemporaryDirectory directory;
    EXPECT_FALSE(try_read(directory / "missing.exr"));
    EXPECT_FALSE(try_read(directory.path()));
    EXPECT_FALSE(try_read("/dev/null"));
    write_file(directory / "text.exr", "this is not an EXR file");
    EXPECT_FALSE(try_read(directory / "text.exr"));
}

TEST(ExrDamage, TheDeepFlagAloneIsRefused) {
    const TemporaryDirectory directory;
    std::vector<char> bytes = small_file(directory);
    bytes[5] = 0x08;  // of the version field
    put(directory / "a.exr", bytes, bytes.size());
    try {
        read_exr(directory / "a.exr");
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("deep image"), std::string::npos) << error.what();
    }
}

TEST(ExrDamage, HugeWindowsAreRefusedBeforeAllocating) {
    const TemporaryDirectory directory;
    const std::vector<char> bytes = small_file(directory);
    const std::string text(bytes.begin(), bytes.end());
    for (const std::string window : {"dataWindow", "displayWindow"}) {
        const size_t at = text.find(window) + window.size() + sizeof("\0box2i\0....") - 1;
        for (const int32_t value : {16383, 0x7fffffff, -5, int32_t(0x80000000)}) {
            std::vector<char> damaged = bytes;
            for (size_t corner : {8, 12}) {  // x_max, y_max
                for (size_t b = 0; b < 4; ++b) {
                    damaged[at + corner + b] =
                        static_cast<char>(static_cast<uint32_t>(value) >> (8 * b));
                }
            }
            put(directory / "a.exr", damaged, damaged.size());
            EXPECT_THROW(read_exr(directory / "a.exr"), Error) << window << " " << value;
        }
    }
}

}  // namespace
}  // namespace paim
