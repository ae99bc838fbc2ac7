// Reads a section container.
#include "paim/format/container/container_reader.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/half.h"
#include "paim/base/hash.h"
#include "paim/format/pack/zstd_decoder.h"

namespace paim {

using container::Header;
using container::TableEntry;

std::string_view scalar_name(ScalarType type) {
    switch (type) {
        case ScalarType::u8:
            return "u8";
        case ScalarType::u32:
            return "u32";
        case ScalarType::f16:
            return "f16";
        case ScalarType::f32:
            return "f32";
        case ScalarType::f64:
            return "f64";
        case ScalarType::i8:
            return "i8";
        case ScalarType::i16:
            return "i16";
    }
    return "unknown";
}

namespace {

// Sums the bytes that sections take or claim, up to a limit.
class ByteBudget {
  public:
    explicit ByteBudget(uint64_t most) : most_(most), left_(most) {}
    bool take(uint64_t size_bytes) {
        if (size_bytes > left_) return false;
        left_ -= size_bytes;
        return true;
    }
    uint64_t most() const { return most_; }

  private:
    uint64_t most_, left_;
};

// a · b, or the largest number if the product overflows.
uint64_t saturating_product(uint64_t a, uint64_t b) {
    uint64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? std::numeric_limits<uint64_t>::max() : product;
}

void check_header(const std::string& name, const Header& header, Tag kind, uint64_t size_bytes,
                  Extent extent) {
    if (header.magic != container::kMagic) throw_bad_input("{}: not a Paim file", name);
    if (header.version != container::kVersion) {
        throw_unsupported("{}: format version {}, expected {}", name, header.version,
                          container::kVersion);
    }
    if (header.header_xxh3 != xxh3(&header, sizeof(header) - sizeof(header.header_xxh3))) {
        throw_bad_input("{}: damaged: the header's checksum does not match", name);
    }
    if (header.kind != kind) {
        throw_bad_input("{}: holds '{}', expected '{}'", name, header.kind.str(), kind.str());
    }
    const bool cut = size_bytes < header.file_size_bytes;
    if (header.file_size_bytes != size_bytes && !(cut && extent == Extent::prefix)) {
        throw_bad_input(
            "{}: {} bytes, expected {}{}", name, size_bytes, header.file_size_bytes,
            cut ? ": the file is cut short (paim-play --progressive plays what is there of a .paim)"
                : "");
    }
    if (header.num_sections > container::kMaxSections ||
        header.num_sections > (header.file_size_bytes - sizeof(Header)) / sizeof(TableEntry)) {
        throw_bad_input("{}: {} sections do not fit in {} bytes", name, header.num_sections,
                        header.file_size_bytes);
    }
    const uint64_t table_end = sizeof(Header) + header.num_sections * sizeof(TableEntry);
    if (size_bytes < table_end) {
        throw_bad_input("{}: {} bytes, expected at least the {} of header and section table", name,
                        size_bytes, table_end);
    }
}

Section check_entry(const std::string& name, const TableEntry& entry, uint64_t file_size_bytes,
                    uint64_t table_end) {
    const auto type = static_cast<ScalarType>(entry.type);
    const uint64_t scalar_bytes = scalar_size_bytes(type);
    const uint64_t num_values =
        saturating_product(saturating_product(entry.shape[0], entry.shape[1]), entry.shape[2]);
    const std::string tag = entry.tag.str();
    if (scalar_bytes == 0) {
        throw_unsupported("{}: section {} {}: unknown value type {}", name, tag, entry.index,
                          entry.type);
    }
    if (entry.codec > SectionCodec::planes) {
        throw_unsupported("{}: section {} {}: unknown codec {}", name, tag, entry.index,
                          static_cast<int>(entry.codec));
    }
    if (saturating_product(num_values, scalar_bytes) != entry.raw_size_bytes ||
        (entry.codec == SectionCodec::none && entry.raw_size_bytes != entry.stored_size_bytes)) {
        throw_bad_input("{}: section {} {}: {} bytes for {} x {} x {} values of {}", name, tag,
                        entry.index, entry.stored_size_bytes, entry.shape[0], entry.shape[1],
                        entry.shape[2], scalar_name(type));
    }
    if (entry.offset < table_end || entry.offset > file_size_bytes ||
        entry.stored_size_bytes > file_size_bytes - entry.offset) {
        throw_bad_input("{}: section {} {}: bytes {} + {} lie outside the file's {}", name, tag,
                        entry.index, entry.offset, entry.stored_size_bytes, file_size_bytes);
    }
    return {{entry.tag, type, entry.index, entry.shape},
            entry.offset,
            entry.stored_size_bytes,
            entry.xxh3,
            entry.codec};
}

}  // namespace

ContainerReader::ContainerReader(const std::filesystem::path& path, Tag kind, Extent extent)
    : ContainerReader(std::make_shared<FileSource>(path), path.string(), kind, extent) {}

ContainerReader::ContainerReader(std::shared_ptr<const ByteSource> source, std::string name,
                                 Tag kind, Extent extent)
    : source_(std::move(source)), name_(std::move(name)), file_size_bytes_(source_->size_bytes()) {
    if (file_size_bytes_ < sizeof(Header)) {
        throw_bad_input("{}: {} bytes, expected at least the {} of a header", name_,
                        file_size_bytes_, sizeof(Header));
    }
    Header header;
    read_bytes(0, &header, sizeof(header));
    check_header(name_, header, kind, file_size_bytes_, extent);
    std::vector<TableEntry> table(header.num_sections);
    const uint64_t table_bytes = table.size() * sizeof(TableEntry);
    read_bytes(sizeof(header), table.data(), table_bytes);
    if (header.table_xxh3 != xxh3(table.data(), table_bytes)) {
        throw_bad_input("{}: damaged: the section table's checksum does not match", name_);
    }
    check_table(table, header.file_size_bytes);
}

void ContainerReader::check_table(const std::vector<TableEntry>& table, uint64_t whole_size_bytes) {
    const uint64_t table_end = sizeof(Header) + table.size() * sizeof(TableEntry);
    // Sections that share bytes would let a small file claim any amount of memory, and so would the
    // size in the header. So the limit is the number of bytes that the source has.
    ByteBudget stored(file_size_bytes_ - table_end);
    ByteBudget values(most_bytes_of_values(file_size_bytes_));
    sections_.reserve(table.size());
    for (const TableEntry& entry : table) {
        sections_.push_back(check_entry(name_, entry, whole_size_bytes, table_end));
        if (!holds(sections_.back())) continue;
        if (!stored.take(entry.stored_size_bytes)) {
            throw_bad_input("{}: sections overlap: more than {} bytes in all", name_,
                            stored.most());
        }
        if (!values.take(entry.raw_size_bytes)) {
            throw_bad_input("{}: sections claim more than {} bytes of values", name_,
                            values.most());
        }
    }
}

const Section* ContainerReader::find(Tag tag, uint32_t index) const {
    const auto found = std::find_if(sections_.begin(), sections_.end(), [&](const Section& s) {
        return s.spec.tag == tag && s.spec.index == index;
    });
    return found == sections_.end() ? nullptr : &*found;
}

const Section& ContainerReader::require(Tag tag, ScalarType type, uint32_t index) const {
    const Section* section = find(tag, index);
    if (section == nullptr)
        throw_bad_input("{}: section {} {} is missing", name_, tag.str(), index);
    expect_type(*section, type);
    return *section;
}

void ContainerReader::expect_type(const Section& section, ScalarType type) const {
    if (section.spec.type != type) {
        throw_bad_input("{}: holds {}, expected {}", label(section), scalar_name(section.spec.type),
                        scalar_name(type));
    }
}

std::string ContainerReader::label(const Section& section) const {
    return message("{}: section {} {}", name_, section.spec.tag.str(), section.spec.index);
}

void ContainerReader::read_bytes(uint64_t offset, void* out, uint64_t size_bytes) const {
    const size_t got = source_->read(offset, {static_cast<uint8_t*>(out), size_bytes});
    if (got != size_bytes) {
        throw_bad_input("{}: ends after {} bytes, expected at least {}", name_, offset + got,
                        offset + size_bytes);
    }
}

template <typename T>
std::vector<T> ContainerReader::read_values(const Section& section, ScalarType type) const {
    expect_type(section, type);
    std::vector<T> values(section.spec.num_values());
    if (section.codec == SectionCodec::zstd) {
        const std::vector<uint8_t> stored = read_stored(section);
        const std::span bytes(reinterpret_cast<uint8_t*>(values.data()), values.size() * sizeof(T));
        if (!zstd_decompress(stored, bytes)) {
            throw_bad_input("{}: holds no {} bytes of Zstandard", label(section), bytes.size());
        }
        return values;
    }
    if (section.codec != SectionCodec::none) {
        throw_unsupported("{}: codec {} for {}", label(section), static_cast<int>(section.codec),
                          scalar_name(type));
    }
    read_bytes(section.offset, values.data(), section.stored_size_bytes);
    if (xxh3(values.data(), section.stored_size_bytes) != section.xxh3) {
        throw_bad_input("{}: damaged: the checksum does not match", label(section));
    }
    return values;
}

std::vector<uint8_t> ContainerReader::read_stored(const Section& section) const {
    std::vector<uint8_t> bytes(section.stored_size_bytes);
    read_bytes(section.offset, bytes.data(), bytes.size());
    if (xxh3(bytes.data(), bytes.size()) != section.xxh3) {
        throw_bad_input("{}: damaged: the checksum does not match", label(section));
    }
    return bytes;
}

std::vector<uint8_t> ContainerReader::read_u8(const Section& section) const {
    return read_values<uint8_t>(section, ScalarType::u8);
}

std::vector<uint32_t> ContainerReader::read_u32(const Section& section) const {
    return read_values<uint32_t>(section, ScalarType::u32);
}

std::vector<float> ContainerReader::read_f32(const Section& section) const {
    if (section.spec.type != ScalarType::f16) return read_values<float>(section, ScalarType::f32);
    const auto halves = read_values<uint16_t>(section, ScalarType::f16);
    std::vector<float> values(halves.size());
    std::transform(halves.begin(), halves.end(), values.begin(), from_half);
    return values;
}

std::vector<double> ContainerReader::read_f64(const Section& section) const {
    return read_values<double>(section, ScalarType::f64);
}

std::string ContainerReader::read_text(const Section& section) const {
    const auto bytes = read_u8(section);
    return {bytes.begin(), bytes.end()};
}

void ContainerReader::read_range(const Section& section, uint64_t first, uint64_t count,
                                 float* out) const {
    if (section.codec != SectionCodec::none) {
        throw_unsupported("{}: compressed, expected values as they are", label(section));
    }
    PAIM_CHECK_LE(first, section.spec.num_values());
    PAIM_CHECK_LE(count, section.spec.num_values() - first);
    if (section.spec.type == ScalarType::f16) {
        std::vector<uint16_t> halves(count);
        read_bytes(section.offset + first * sizeof(uint16_t), halves.data(),
                   count * sizeof(uint16_t));
        std::transform(halves.begin(), halves.end(), out, from_half);
        return;
    }
    expect_type(section, ScalarType::f32);
    read_bytes(section.offset + first * sizeof(float), out, count * sizeof(float));
}

void ContainerReader::verify(const Section& section) const {
    StreamingHash hash;
    std::vector<char> buffer(std::min<uint64_t>(section.stored_size_bytes, 1 << 20));
    for (uint64_t done = 0; done < section.stored_size_bytes;) {
        const uint64_t size_bytes =
            std::min<uint64_t>(buffer.size(), section.stored_size_bytes - done);
        read_bytes(section.offset + done, buffer.data(), size_bytes);
        hash.update(buffer.data(), size_bytes);
        done += size_bytes;
    }
    if (hash.digest() != section.xxh3) {
        throw_bad_input("{}: damaged: the checksum does not match", label(section));
    }
}

void ContainerReader::verify_all() const {
    for (const Section& section : sections_) verify(section);
}

}  // namespace paim
