// Reads a section container from a file, memory or any other source of bytes. Damaged bytes give an
// error that says what is wrong: every size is checked against that of the source before memory is
// taken.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "paim/format/container/byte_source.h"
#include "paim/format/container/container.h"

namespace paim {

// Whether the source has a whole file.
enum class Extent {
    whole,   // a file that is cut short is an error
    prefix,  // header and table at least; holds() tells which sections are complete
};

class ContainerReader {
  public:
    // Reads and checks header and table. `name` stands for the source in messages.
    // Errors (bad input; unsupported for a newer version or an unknown codec) begin with the name
    // and say what was expected and what was got.
    ContainerReader(std::shared_ptr<const ByteSource> source, std::string name, Tag kind,
                    Extent extent = Extent::whole);

    // The same for a file.
    ContainerReader(const std::filesystem::path& path, Tag kind, Extent extent = Extent::whole);

    const std::vector<Section>& sections() const { return sections_; }
    // The size of the source when the reader was made.
    uint64_t file_size_bytes() const { return file_size_bytes_; }
    // The source in messages: the path of a file, or the name given for bytes in memory.
    const std::string& name() const { return name_; }

    // Whether the source has all bytes of the section. Reading an incomplete section is an error.
    bool holds(const Section& section) const {
        return section.offset + section.stored_size_bytes <= file_size_bytes_;
    }

    // The section with this tag and index, or nullptr.
    const Section* find(Tag tag, uint32_t index = 0) const;

    // The same; an error (bad input) if there is no such section, or it has another type.
    const Section& require(Tag tag, ScalarType type, uint32_t index = 0) const;

    // The stored bytes of a section, its checksum verified, for code that decodes them itself.
    std::vector<uint8_t> read_stored(const Section& section) const;

    // All values of the section, its checksum verified. Errors: bad input if it holds another type,
    // unsupported if its codec is neither none nor zstd.
    std::vector<uint8_t> read_u8(const Section& section) const;
    std::vector<uint32_t> read_u32(const Section& section) const;
    std::vector<float> read_f32(const Section& section) const;  // an f16 section is widened
    std::vector<double> read_f64(const Section& section) const;
    std::string read_text(const Section& section) const;

    // Values [first, first + count) of an f32 or f16 section without codec. The checksum is not
    // checked; call verify() once before.
    void read_range(const Section& section, uint64_t first, uint64_t count, float* out) const;

    // Reads all bytes of the section and checks its checksum.
    void verify(const Section& section) const;
    void verify_all() const;

    // "NAME: section TAG INDEX", for messages.
    std::string label(const Section& section) const;

  private:
    void expect_type(const Section& section, ScalarType type) const;
    template <typename T>
    std::vector<T> read_values(const Section& section, ScalarType type) const;
    void check_table(const std::vector<container::TableEntry>& table, uint64_t whole_size_bytes);
    void read_bytes(uint64_t offset, void* out, uint64_t size_bytes) const;

    std::shared_ptr<const ByteSource> source_;
    std::string name_;
    uint64_t file_size_bytes_ = 0;
    std::vector<Section> sections_;
};

}  // namespace paim
