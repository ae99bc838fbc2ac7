// The section container: round trip, every truncation, every damaged byte, hostile sizes.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/hash.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/container_writer.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr Tag kKind("TEST");

const std::vector<SectionPlan> kSpecs{SectionSpec{Tag("BYTE"), ScalarType::u8, 0, {1, 1, 5}},
                                      SectionSpec{Tag("REAL"), ScalarType::f32, 7, {1, 2, 3}},
                                      SectionSpec{Tag("NONE"), ScalarType::f64, 0, {1, 1, 0}}};
const std::vector<uint8_t> kBytes{1, 2, 3, 4, 5};
const std::vector<float> kReals{0.5f, -1, 2, 3, 4, 5};

void write_example(const std::filesystem::path& path) {
    ContainerWriter writer(path, kKind, kSpecs);
    // Side by side, in pieces.
    writer.append(1, std::span(kReals).first(2));
    writer.append(0, std::span(kBytes));
    writer.append(1, std::span(kReals).subspan(2));
    writer.commit();
}

std::string bytes_of(const std::filesystem::path& path) {
    const auto bytes = read_file(path, 1 << 20);
    return {bytes.begin(), bytes.end()};
}

// What reading everything in the file says; empty if all is well.
std::string complaint(const std::filesystem::path& path) {
    try {
        const ContainerReader reader(path, kKind);
        reader.verify_all();
        return {};
    } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::unsupported);
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
        return error.what();
    }
}

TEST(Container, RoundTrips) {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    const ContainerReader reader(directory / "x", kKind);
    ASSERT_EQ(reader.sections().size(), 3u);
    for (size_t s = 0; s < kSpecs.size(); ++s) {
        EXPECT_EQ(reader.sections()[s].spec, kSpecs[s].spec);
        EXPECT_EQ(reader.sections()[s].offset % container::kAlignment, 0u);
    }
    EXPECT_EQ(reader.read_u8(reader.require(Tag("BYTE"), ScalarType::u8)), kBytes);
    const Section& reals = reader.require(Tag("REAL"), ScalarType::f32, 7);
    EXPECT_EQ(reader.read_f32(reals), kReals);
    float middle[2];
    reader.read_range(reals, 2, 2, middle);
    EXPECT_EQ(middle[0], 2.0f);
    EXPECT_EQ(middle[1], 3.0f);
    EXPECT_EQ(reader.find(Tag("REAL"), 0), nullptr);
    EXPECT_THROW(reader.require(Tag("REAL"), ScalarType::u8, 7), Error);
    EXPECT_EQ(reader.file_size_bytes(), container_size_bytes(kSpecs));
}

TEST(Container, RefusesEveryTruncationAndAnExtraByte) {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    const std::string whole = bytes_of(directory / "x");
    for (size_t length = 0; length < whole.size(); ++length) {
        write_file(directory / "cut", whole.substr(0, length));
        EXPECT_NE(complaint(directory / "cut"), "") << length;
    }
    write_file(directory / "long", whole + "x");
    EXPECT_NE(complaint(directory / "long"), "");
}

TEST(Container, NoticesEveryDamagedByteThatMeansSomething) {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    const std::string whole = bytes_of(directory / "x");
    std::vector<bool> is_padding(whole.size(), true);
    const auto meaningful = [&](uint64_t offset, uint64_t size) {
        for (uint64_t j = offset; j < offset + size; ++j) is_padding[j] = false;
    };
    const ContainerReader reader(directory / "x", kKind);
    meaningful(0, sizeof(container::Header) + 3 * sizeof(container::TableEntry));
    for (const Section& section : reader.sections()) {
        meaningful(section.offset, section.stored_size_bytes);
    }
    for (size_t j = 0; j < whole.size(); ++j) {
        std::string damaged = whole;
        damaged[j] = static_cast<char>(damaged[j] ^ 0x10);
        write_file(directory / "damaged", damaged);
        EXPECT_EQ(complaint(directory / "damaged").empty(), is_padding[j]) << j;
    }
}

TEST(Container, RefusesPipesWithoutWaiting) {
    const TemporaryDirectory directory;
    ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0600), 0);
    EXPECT_NE(complaint(directory / "pipe").find("expected a regular file"), std::string::npos);
}

TEST(Container, KnowsTheSizeOfEveryValue) {
    EXPECT_EQ(scalar_size_bytes(ScalarType::u8), sizeof(uint8_t));
    EXPECT_EQ(scalar_size_bytes(ScalarType::i8), sizeof(int8_t));
    EXPECT_EQ(scalar_size_bytes(ScalarType::i16), sizeof(int16_t));
    EXPECT_EQ(scalar_size_bytes(ScalarType::f16), sizeof(uint16_t));
    EXPECT_EQ(scalar_size_bytes(ScalarType::u32), sizeof(uint32_t));
    EXPECT_EQ(scalar_size_bytes(ScalarType::f32), sizeof(float));
    EXPECT_EQ(scalar_size_bytes(ScalarType::f64), sizeof(double));
    EXPECT_EQ(scalar_size_bytes(static_cast<ScalarType>(99)), 0u);
}

TEST(Container, RefusesAnotherKind) {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    EXPECT_THROW(ContainerReader(directory / "x", Tag("ELSE")), Error);
}

// Writes the example with its first table entry changed and every checksum made right again.
template <typename Change>
void write_hostile(const std::filesystem::path& path, const Change& change) {
    write_example(path);
    std::string whole = bytes_of(path);
    container::Header header;
    std::memcpy(&header, whole.data(), sizeof(header));
    std::vector<container::TableEntry> table(header.num_sections);
    const size_t table_bytes = table.size() * sizeof(table[0]);
    std::memcpy(table.data(), whole.data() + sizeof(header), table_bytes);
    change(header, table);
    header.table_xxh3 = xxh3(table.data(), table_bytes);
    header.header_xxh3 = xxh3(&header, sizeof(header) - sizeof(header.header_xxh3));
    std::memcpy(whole.data(), &header, sizeof(header));
    std::memcpy(whole.data() + sizeof(header), table.data(), table_bytes);
    write_file(path, whole);
}

TEST(Container, RefusesHostileSizesWithRightChecksums) {
    using container::Header;
    using container::TableEntry;
    const TemporaryDirectory directory;
    const std::filesystem::path path = directory / "x";
    const auto expect_refused = [&](auto change, const char* message) {
        write_hostile(path, change);
        EXPECT_NE(complaint(path).find(message), std::string::npos) << complaint(path);
    };
    using Table = std::vector<TableEntry>;
    expect_refused([](Header&, Table& t) { t[0].stored_size_bytes = t[0].raw_size_bytes = ~0ull; },
                   "bytes for 1 x 1 x 5");
    expect_refused(
        [](Header&, Table& t) {
            t[0].shape = {0xffffffffu, 0xffffffffu, 0xffffffffu};  // overflows 64 bits
            t[0].raw_size_bytes = t[0].stored_size_bytes = ~0ull;
        },
        "lie outside");
    expect_refused([](Header&, Table& t) { t[0].offset = ~0ull - 2; }, "lie outside");
    expect_refused([](Header&, Table& t) { t[0].offset = 0; }, "lie outside");
    expect_refused([](Header&, Table& t) { t[0].type = 99; }, "unknown value type");
    expect_refused([](Header&, Table& t) { t[0].codec = static_cast<SectionCodec>(9); },
                   "unknown codec");
    expect_refused(
        [](Header&, Table& t) {
            t[0].codec = SectionCodec::zstd;
            t[0].shape = {0xffffffffu, 0xffffffffu, 0xffffffffu};  // overflows 64 bits
            t[0].raw_size_bytes = ~0ull;
        },
        "sections claim more than");
    expect_refused(
        [](Header&, Table& t) {
            for (size_t s : {0, 1}) {  // each by itself is allowed
                t[s].codec = SectionCodec::zstd;
                t[s].shape = {1, 1, 40u << 20};
                t[s].raw_size_bytes = (s == 0 ? 1ull : 4ull) * (40u << 20);
            }
        },
        "sections claim more than");
    expect_refused([](Header& h, Table&) { h.version = 2; }, "format version 2, expected 1");
    expect_refused([](Header& h, Table&) { h.num_sections = 0x7fffffff; }, "do not fit");
    expect_refused(
        [](Header&, Table& t) {
            for (auto& entry : t) {
                entry = t[1];
                entry.shape = {1, 32, 1};
                entry.raw_size_bytes = entry.stored_size_bytes = 128;
                entry.offset = 256;
            }
        },
        "overlap");
}

}  // namespace
}  // namespace paim
