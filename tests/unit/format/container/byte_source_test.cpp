// Sources of bytes: memory and files give the same answers, growing ones are read as far as they
// go, and no bytes in memory, cut or damaged, do more than throw an Error.
#include "paim/format/container/byte_source.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <numeric>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/half.h"
#include "paim/base/hash.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/pack/zstd_encoder.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

using Bytes = std::vector<uint8_t>;
using container::Header;
using container::TableEntry;

constexpr Tag kKind("TEST");
const std::vector<float> kReals{0.5f, -1, 2, 3, 4, 5};
const std::vector<uint16_t> kHalves{to_half(0.25f), to_half(-8.0f)};

// Every way in which a reader takes values: as they are, widened, and through Zstandard.
void write_example(const std::filesystem::path& path) {
    std::vector<uint8_t> text(200);
    std::iota(text.begin(), text.end(), uint8_t{0});
    const std::vector<uint8_t> packed = zstd_compress(text);
    ContainerWriter writer(path, kKind,
                           {SectionSpec{Tag("REAL"), ScalarType::f32, 7, {1, 2, 3}},
                            SectionSpec{Tag("HALF"), ScalarType::f16, 0, {1, 1, 2}},
                            {SectionSpec{Tag("TEXT"), ScalarType::u8, 0, {1, 1, 200}},
                             SectionCodec::zstd, packed.size()}});
    writer.append(0, std::span(kReals));
    writer.append(1, std::span(kHalves));
    writer.append(2, std::span(packed));
    writer.commit();
}

Bytes bytes_of(const std::filesystem::path& path) {
    const auto bytes = read_file(path, 1 << 20);
    return {bytes.begin(), bytes.end()};
}

Bytes example() {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    return bytes_of(directory / "x");
}

ContainerReader open_memory(std::span<const uint8_t> bytes, Extent extent = Extent::whole) {
    return {std::make_shared<MemorySource>(bytes), "archive/x", kKind, extent};
}

// All values of the sections that are there.
std::vector<float> read_everything(const ContainerReader& reader) {
    std::vector<float> all;
    for (const Section& section : reader.sections()) {
        if (!reader.holds(section)) continue;
        reader.verify(section);
        if (section.spec.type == ScalarType::u8) {
            for (const uint8_t value : reader.read_u8(section)) all.push_back(value);
        } else {
            for (const float value : reader.read_f32(section)) all.push_back(value);
            float first = 0.0f;
            reader.read_range(section, 0, std::min<uint64_t>(1, section.spec.num_values()), &first);
            all.push_back(first);
        }
    }
    return all;
}

// What reading everything there is says; empty if all is well. The bytes are given as memory of
// exactly that size, beyond which a sanitizer sees every access.
std::string complaint(const Bytes& bytes, Extent extent) {
    const auto exact = std::make_unique<uint8_t[]>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), exact.get());
    try {
        read_everything(open_memory({exact.get(), bytes.size()}, extent));
        return {};
    } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ExitCode::bad_input || error.code() == ExitCode::unsupported);
        EXPECT_TRUE(std::string_view(error.what()).starts_with("archive/x: ")) << error.what();
        return error.what();
    }
}

// Makes the checksums of header and table right.
void mend(Bytes& bytes) {
    Header header;
    std::memcpy(&header, bytes.data(), sizeof(header));
    const uint64_t table_bytes = uint64_t{header.num_sections} * sizeof(TableEntry);
    if (table_bytes <= bytes.size() - sizeof(header)) {
        header.table_xxh3 = xxh3(bytes.data() + sizeof(header), table_bytes);
    }
    header.header_xxh3 = xxh3(&header, sizeof(header) - sizeof(header.header_xxh3));
    std::memcpy(bytes.data(), &header, sizeof(header));
}

TEST(ByteSource, FirstBytesEndEarly) {
    const Bytes bytes{1, 2, 3, 4, 5};
    const auto memory = std::make_shared<MemorySource>(bytes);
    const FirstBytes source(memory, 3);
    EXPECT_EQ(source.size_bytes(), 3u);
    Bytes out(4, 9);
    EXPECT_EQ(source.read(1, out), 2u);
    EXPECT_EQ(out, (Bytes{2, 3, 9, 9}));
    EXPECT_EQ(source.read(3, out), 0u);
    EXPECT_EQ(FirstBytes(memory, 8).size_bytes(), 5u);
    EXPECT_EQ(FirstBytes(memory, 8).read(4, out), 1u);
}

TEST(ByteSource, MemoryEndsWhereItEnds) {
    const Bytes bytes{1, 2, 3, 4, 5};
    const MemorySource source(bytes);
    EXPECT_EQ(source.size_bytes(), 5u);
    Bytes out(3, 9);
    EXPECT_EQ(source.read(1, out), 3u);
    EXPECT_EQ(out, (Bytes{2, 3, 4}));
    EXPECT_EQ(source.read(3, out), 2u);
    EXPECT_EQ(out, (Bytes{4, 5, 4}));
    EXPECT_EQ(source.read(5, out), 0u);
    EXPECT_EQ(source.read(~uint64_t{0}, out), 0u);
    EXPECT_EQ(out, (Bytes{4, 5, 4}));
}

TEST(ByteSource, MemoryAndFileGiveTheSame) {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    const Bytes bytes = bytes_of(directory / "x");
    const ContainerReader file(directory / "x", kKind);
    const ContainerReader memory = open_memory(bytes);
    EXPECT_EQ(memory.file_size_bytes(), file.file_size_bytes());
    ASSERT_EQ(memory.sections().size(), file.sections().size());
    for (size_t s = 0; s < file.sections().size(); ++s) {
        EXPECT_EQ(memory.sections()[s].spec, file.sections()[s].spec);
        EXPECT_EQ(memory.sections()[s].offset, file.sections()[s].offset);
        EXPECT_EQ(memory.read_stored(memory.sections()[s]), file.read_stored(file.sections()[s]));
    }
    const std::vector<float> values = read_everything(memory);
    EXPECT_EQ(values, read_everything(file));
    EXPECT_EQ(values.size(), 6u + 1 + 2 + 1 + 200);
    EXPECT_EQ(std::vector<float>(values.begin(), values.begin() + 6), kReals);
}

TEST(ByteSource, OneFileIsReadAgainAsItGrows) {
    const TemporaryDirectory directory;
    write_example(directory / "x");
    const Bytes bytes = bytes_of(directory / "x");
    const size_t cut = bytes.size() - 1;
    const auto append = [&](size_t begin, size_t end) {
        std::ofstream file(directory / "growing", std::ios::binary | std::ios::app);
        file.write(reinterpret_cast<const char*>(bytes.data() + begin),
                   static_cast<std::streamsize>(end - begin));
    };
    append(0, cut);
    const auto source = std::make_shared<FileSource>(directory / "growing");
    EXPECT_EQ(source->size_bytes(), cut);
    EXPECT_THROW(ContainerReader(source, "x", kKind), Error);
    const ContainerReader before(source, "x", kKind, Extent::prefix);
    EXPECT_FALSE(before.holds(before.sections().back()));

    append(cut, bytes.size());
    EXPECT_EQ(source->size_bytes(), bytes.size());
    EXPECT_FALSE(before.holds(before.sections().back()));  // what was there when it was made
    EXPECT_EQ(read_everything(ContainerReader(source, "x", kKind)),
              read_everything(open_memory(bytes)));
}

TEST(ByteSource, ASectionThatIsNotThereIsAnError) {
    const Bytes bytes = example();
    const ContainerReader reader =
        open_memory(std::span(bytes).first(bytes.size() - 1), Extent::prefix);
    const Section& last = reader.sections().back();
    EXPECT_FALSE(reader.holds(last));
    EXPECT_THROW(reader.read_stored(last), Error);
    EXPECT_THROW(reader.verify(last), Error);
}

// A file may lose bytes while it is read, and a source of the program's own may be wrong.
TEST(ByteSource, FewerBytesThanPromisedAreAnError) {
    class Shrunk : public ByteSource {
      public:
        explicit Shrunk(std::span<const uint8_t> bytes) : bytes_(bytes) {}
        uint64_t size_bytes() const override { return bytes_.size(); }
        size_t read(uint64_t offset, std::span<uint8_t> out) const override {
            return MemorySource(bytes_.first(bytes_.size() - 1)).read(offset, out);
        }

      private:
        std::span<const uint8_t> bytes_;
    };
    const Bytes bytes = example();
    const ContainerReader reader(std::make_shared<Shrunk>(bytes), "x", kKind);
    try {
        reader.verify_all();
        FAIL() << "expected an Error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_EQ(std::string(error.what()), "x: ends after " + std::to_string(bytes.size() - 1) +
                                                 " bytes, expected at least " +
                                                 std::to_string(bytes.size()));
    }
}

TEST(HostileMemory, EveryCutIsRefusedOrReadAsFarAsItGoes) {
    const Bytes whole = example();
    const uint64_t table_end = sizeof(Header) + 3 * sizeof(TableEntry);
    for (size_t length = 0; length < whole.size(); ++length) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(length));
        EXPECT_NE(complaint(cut, Extent::whole), "") << length;
        EXPECT_EQ(complaint(cut, Extent::prefix).empty(), length >= table_end) << length;
    }
    EXPECT_EQ(complaint(whole, Extent::whole), "");
}

TEST(HostileMemory, EveryDamagedByteIsNoticedOrMeansNothing) {
    const Bytes whole = example();
    std::vector<bool> is_padding(whole.size(), true);
    const auto meaningful = [&](uint64_t offset, uint64_t size) {
        for (uint64_t j = offset; j < offset + size; ++j) is_padding[j] = false;
    };
    const ContainerReader reader = open_memory(whole);
    meaningful(0, sizeof(Header) + reader.sections().size() * sizeof(TableEntry));
    for (const Section& section : reader.sections()) {
        meaningful(section.offset, section.stored_size_bytes);
    }
    for (const uint8_t flips : {0x01, 0x10, 0x80, 0xff}) {
        for (size_t j = 0; j < whole.size(); ++j) {
            Bytes damaged = whole;
            damaged[j] ^= flips;
            EXPECT_EQ(complaint(damaged, Extent::whole).empty(), is_padding[j]) << j;
            complaint(damaged, Extent::prefix);
        }
    }
}

// With checksums that are right, header and table may say anything.
TEST(HostileMemory, NoHeaderOrTableDoesMoreThanThrow) {
    const Bytes whole = example();
    for (const uint8_t flips : {0x01, 0x02, 0x08, 0x40, 0x80, 0xff}) {
        for (size_t j = 0; j < sizeof(Header) + 3 * sizeof(TableEntry); ++j) {
            Bytes damaged = whole;
            damaged[j] ^= flips;
            mend(damaged);
            for (const Extent extent : {Extent::whole, Extent::prefix}) {
                const std::string message = complaint(damaged, extent);
                EXPECT_EQ(message.find("header's checksum"), std::string::npos) << message;
                EXPECT_EQ(message.find("table's checksum"), std::string::npos) << message;
            }
        }
    }
}

}  // namespace
}  // namespace paim
