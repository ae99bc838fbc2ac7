// Reads a section container from a file, memory or any other source of bytes. Whatever the bytes, the
// answer is right or a clear error: every size is checked against the source's before anything is
// allocated.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "paim/format/container/byte_source.h"
#include "paim/format/container/container.h"

namespace paim {

// How much of a file there is.
enum class Extent {
    whole,   // a file that is cut short is an error
    prefix,  // at least header and table; holds() tells which sections are there
};

class ContainerReader {
  public:
    // Checks header and table of what the source has now. `name` stands for it in messages.
    // Errors (bad input; unsupported for a newer version or an unknown codec) begin with the name
    // and say what was expected and what was got.
    ContainerReader(std::shared_ptr<const ByteSource> source, std::string name, Tag kind,
                    Extent extent = Extent::whole);

    // The same of a file, by its path.
    ContainerReader(const std::filesystem::path& path, Tag kind, Extent extent = Extent::whole);

    const std::vector<Section>& sections() const { return sections_; }
    // Of the bytes that were there when the reader was made.
    uint64_t file_size_bytes() const { return file_size_bytes_; }
    // The source in messages: the path of a file, or the name given for bytes in memory.
    const std::string& name() const { return name_; }

    // Whether all bytes of the section are there; reading one that is not is an error.
    bool holds(const Section& section) const {
        return section.offset + section.stored_size_bytes <= file_size_bytes_;
    }

    // The section with this tag and index, or nullptr.
    const Section* find(Tag tag, uint32_t index = 0) const;

    // The same, of this type; an error if there is none.
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

    // Values [first, first + count) of an f32 or f16 section without codec, unverified: for
    // streaming after verify().
    void read_range(const Section& section, uint64_t first, uint64_t count, float* out) const;

    // Reads the section through and checks its checksum.
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
