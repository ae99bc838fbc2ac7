// What planes of integers are packed into before Zstandard, whose version must not matter: kind by
// kind, as hexadecimal numbers in planes_v1.txt. Files are smaller or larger if this changes, but
// are read all the same: a change is to be seen and meant, not forbidden.
//
// PAIM_UPDATE_GOLDEN=1 writes the file again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "paim/base/file.h"
#include "paim/base/seed.h"
#include "paim/format/pack/plane_decoder.h"
#include "paim/format/pack/plane_encoder.h"
#include "paim/format/pack/plane_packing.h"
#include "paim/format/pack/zstd_decoder.h"
#include "tests/grid_surface.h"

namespace paim {
namespace {

using Bytes = std::vector<uint8_t>;

const std::filesystem::path kFile = std::filesystem::path(PAIM_GOLDEN_DIR) / "planes_v1.txt";

constexpr int64_t kWidth = 12;  // of a grid of vertices, and of other planes in rows of so many

// Integers alone, so that they are the same everywhere: a hill of this height under noise.
template <typename Integer>
void append_plane(int64_t height, int64_t noise, uint64_t seed, std::vector<Integer>& values) {
    for (int64_t v = 0; v < kWidth * kWidth; ++v) {
        const int64_t x = v % kWidth, y = v / kWidth;
        const int64_t hill = x * (kWidth - x) * (3 * kWidth - y);  // 0 … 1296
        const auto random = static_cast<int64_t>(mix_bits(1000 * seed + static_cast<uint64_t>(v)) %
                                                 static_cast<uint64_t>(2 * noise + 1));
        values.push_back(static_cast<Integer>(height * hill / 1296 + random - noise));
    }
}

// A plane of every kind of prediction and packing.
template <typename Integer>
std::vector<Integer> some_planes(int64_t largest) {
    std::vector<Integer> values;
    append_plane(0, 0, 1, values);
    values[77] = 1;  // all but one are zero
    append_plane(0, 1, 2, values);
    append_plane(0, 2, 3, values);
    append_plane(0, 6, 4, values);
    append_plane(0, largest, 5, values);
    append_plane(largest, 0, 6, values);
    append_plane(largest - 12, 12, 7, values);
    append_plane(-largest / 2, 2, 8, values);
    return values;
}

struct Packed {
    Bytes contents;  // of the frame
    size_t num_planes = 0;
};

template <typename Integer>
Packed pack(const std::vector<Integer>& values, size_t num_planes,
            const PlanePredictor& predictor) {
    const Bytes frame = encode_planes(values, num_planes, predictor);
    Packed packed{Bytes(zstd_content_size(frame).value()), num_planes};
    EXPECT_TRUE(zstd_decompress(frame, packed.contents));
    // The contents decide the values: in any frame they are the same ones.
    std::vector<Integer> back(values.size());
    EXPECT_TRUE(
        decode_planes(zstd_compress(packed.contents), num_planes, predictor, std::span(back)));
    EXPECT_EQ(back, values);
    return packed;
}

// Weights of components over poses: slow waves, of numbers that do not fit in a byte or do.
template <typename Integer>
std::vector<Integer> some_weights(int64_t largest) {
    std::vector<Integer> values;
    for (int64_t k = 1; k <= 3; ++k) {
        for (int64_t p = 0; p < 40; ++p) {
            const int64_t phase = k * p % 40;  // a triangle wave, ± largest
            values.push_back(static_cast<Integer>(largest * std::abs(phase - 20) / 10 - largest));
        }
    }
    return values;
}

std::map<std::string, Packed> all_kinds() {
    const PlanePredictor mesh{make_grid(kWidth)}, rows, poses = PlanePredictor::chain(40);
    return {
        {"mesh_i8", pack(some_planes<int8_t>(100), 8, mesh)},
        {"mesh_i16", pack(some_planes<int16_t>(9000), 8, mesh)},
        {"bases_i8", pack(some_planes<int8_t>(100), 8, rows)},
        {"bases_i16", pack(some_planes<int16_t>(9000), 8, rows)},
        {"weights_i8", pack(some_weights<int8_t>(90), 3, poses)},
        {"weights_i16", pack(some_weights<int16_t>(20000), 3, poses)},
    };
}

// "NAME", then lines of 32 bytes.
std::string text_of(const std::map<std::string, Packed>& kinds) {
    std::string text;
    for (const auto& [name, packed] : kinds) {
        text += name;
        for (size_t j = 0; j < packed.contents.size(); ++j) {
            text += fmt::format("{}{:02x}", j % 32 == 0 ? "\n" : "", packed.contents[j]);
        }
        text += "\n";
    }
    return text;
}

std::map<std::string, Bytes> golden() {
    const std::vector<char> file = read_file(kFile, 1 << 20);
    std::istringstream lines{std::string(file.begin(), file.end())};
    std::map<std::string, Bytes> kinds;
    Bytes* bytes = nullptr;
    for (std::string line; std::getline(lines, line);) {
        if (line.find('_') != std::string::npos) {
            bytes = &kinds[line];
            continue;
        }
        for (size_t j = 0; j + 1 < line.size(); j += 2) {
            bytes->push_back(static_cast<uint8_t>(std::stoul(line.substr(j, 2), nullptr, 16)));
        }
    }
    return kinds;
}

TEST(GoldenPlanes, ArePackedByteForByte) {
    const auto kinds = all_kinds();
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) write_file(kFile, text_of(kinds));
    const auto expected = golden();
    ASSERT_EQ(expected.size(), kinds.size());
    for (const auto& [name, packed] : kinds) {
        const Bytes& bytes = expected.at(name);
        const auto [here, there] = std::mismatch(packed.contents.begin(), packed.contents.end(),
                                                 bytes.begin(), bytes.end());
        EXPECT_TRUE(packed.contents == bytes)
            << name << ": " << packed.contents.size() << " bytes, expected " << bytes.size()
            << ", other from byte " << here - packed.contents.begin() << " on";
    }
}

// Headers are six bytes a plane (docs/format.md): prediction, and the largest digit.
TEST(GoldenPlanes, HaveEveryPredictionAndEveryPacking) {
    std::set<int> predictions, magnitudes, wide;
    for (const auto& [name, packed] : all_kinds()) {
        for (size_t j = 0; j < packed.num_planes; ++j) {
            predictions.insert(packed.contents[6 * j] & 3);
            wide.insert(packed.contents[6 * j] & 4);
            magnitudes.insert(packed.contents[6 * j + 1]);
        }
    }
    EXPECT_EQ(predictions, (std::set<int>{0, 1, 2}));
    EXPECT_EQ(wide, (std::set<int>{0, 4}));
    EXPECT_EQ(magnitudes, (std::set<int>(kMagnitudes.begin(), kMagnitudes.end())));
}

}  // namespace
}  // namespace paim
