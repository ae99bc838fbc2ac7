// The section container under every Paim file: header, section table, aligned sections, checksums.
// Layout: docs/format.md. Everything is little-endian.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace paim {

static_assert(std::endian::native == std::endian::little,
              "Paim files are written as memory holds them");

// Four printable characters that name a section or a kind of file.
struct Tag {
    std::array<char, 4> text{};

    constexpr Tag() = default;
    constexpr Tag(const char (&name)[5]) : text{name[0], name[1], name[2], name[3]} {}
    std::string str() const { return {text.data(), text.size()}; }
    bool operator==(const Tag&) const = default;
};

enum class ScalarType : uint8_t { u8 = 0, u32 = 1, f16 = 2, f32 = 3, f64 = 4, i8 = 5, i16 = 6 };

// Size of one value; 0 for a number that is not a ScalarType.
constexpr uint64_t scalar_size_bytes(ScalarType type) {
    switch (type) {
        case ScalarType::u8:
        case ScalarType::i8:
            return 1;
        case ScalarType::u32:
            return 4;
        case ScalarType::f16:
        case ScalarType::i16:
            return 2;
        case ScalarType::f32:
            return 4;
        case ScalarType::f64:
            return 8;
    }
    return 0;
}

std::string_view scalar_name(ScalarType type);

// How the values of a section are stored.
enum class SectionCodec : uint8_t {
    none = 0,  // as they are
    zstd = 1,  // one Zstandard frame
    indices =
        2,  // triangles: meshoptimizer's index codec, then as zstd (format/pack/index_encoder.h)
    planes = 3,  // integers: predicted and packed, then as zstd (format/pack/plane_encoder.h)
};

// The contents of a section: an array of up to three dimensions, the last one contiguous. Unused
// dimensions come first and are 1.
struct SectionSpec {
    Tag tag;
    ScalarType type = ScalarType::u8;
    uint32_t index = 0;  // number of the section among those with its tag, such as the component
    std::array<uint32_t, 3> shape{1, 1, 0};

    uint64_t num_values() const { return uint64_t{shape[0]} * shape[1] * shape[2]; }
    uint64_t size_bytes() const { return num_values() * scalar_size_bytes(type); }
    bool operator==(const SectionSpec&) const = default;
};

// A section and its place in a file.
struct Section {
    SectionSpec spec;
    uint64_t offset = 0;
    uint64_t stored_size_bytes = 0;
    uint64_t xxh3 = 0;
    SectionCodec codec = SectionCodec::none;
};

// The values of all sections of a file take at most this many bytes plus the file's size times the
// expansion below. A file that claims more is refused.
constexpr uint64_t kMaxFreeBytes = uint64_t{1} << 26;
constexpr uint64_t kMaxExpansion = 1024;

// The limit for a file of this size.
constexpr uint64_t most_bytes_of_values(uint64_t file_size_bytes) {
    constexpr uint64_t kMax = std::numeric_limits<uint64_t>::max() - kMaxFreeBytes;
    const uint64_t expanded =
        file_size_bytes > kMax / kMaxExpansion ? kMax : kMaxExpansion * file_size_bytes;
    return kMaxFreeBytes + expanded;
}

namespace container {

constexpr std::array<unsigned char, 8> kMagic{0x89, 'P', 'A', 'I', 'M', '\r', '\n', 0x1a};
constexpr uint32_t kVersion = 1;
constexpr uint64_t kAlignment = 64;
constexpr uint32_t kMaxSections = 1 << 20;

struct Header {
    std::array<unsigned char, 8> magic;
    uint32_t version;
    Tag kind;
    uint64_t file_size_bytes;
    uint32_t num_sections;
    uint32_t reserved_a;  // 0
    uint64_t table_xxh3;
    std::array<uint64_t, 2> reserved_b;  // 0
    uint64_t header_xxh3;                // of the 56 bytes before it
};
static_assert(sizeof(Header) == 64);

struct TableEntry {
    Tag tag;
    uint8_t type;
    SectionCodec codec;
    uint16_t reserved_a;  // 0
    uint32_t index;
    std::array<uint32_t, 3> shape;
    uint64_t reserved_b;  // 0
    uint64_t offset;
    uint64_t stored_size_bytes;
    uint64_t raw_size_bytes;
    uint64_t xxh3;  // of the stored bytes
};
static_assert(sizeof(TableEntry) == 64);

constexpr uint64_t align(uint64_t offset) {
    return (offset + kAlignment - 1) / kAlignment * kAlignment;
}

}  // namespace container

}  // namespace paim
