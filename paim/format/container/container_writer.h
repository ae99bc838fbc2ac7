// Writes a section container, section by section or several side by side, all or nothing.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "paim/base/file.h"
#include "paim/base/hash.h"
#include "paim/format/container/container.h"

namespace paim {

// What a section will hold, and how many bytes of it are stored.
struct SectionPlan {
    SectionSpec spec;
    SectionCodec codec;
    uint64_t stored_size_bytes;

    // Values stored as they are.
    SectionPlan(const SectionSpec& as_it_is)
        : spec(as_it_is), codec(SectionCodec::none), stored_size_bytes(as_it_is.size_bytes()) {}
    SectionPlan(const SectionSpec& values, SectionCodec how, uint64_t size_bytes)
        : spec(values), codec(how), stored_size_bytes(size_bytes) {}
};

// Size of the file that holds these sections, in bytes.
uint64_t container_size_bytes(std::span<const SectionPlan> plans);

class ContainerWriter {
  public:
    // Lays out all sections, in this order. Errors (output failed) name the path.
    ContainerWriter(const std::filesystem::path& path, Tag kind,
                    const std::vector<SectionPlan>& plans);

    // Appends stored bytes to section number `section` of the plans. Sections may be filled side by side.
    void append(size_t section, const void* data, size_t size_bytes);

    template <typename T>
    void append(size_t section, std::span<const T> values) {
        append(section, values.data(), values.size_bytes());
    }

    // Every section must be full by now (checked).
    void commit();

  private:
    struct Open {
        Section section;
        StreamingHash hash;
        uint64_t filled_bytes = 0;
    };

    AtomicFile file_;
    Tag kind_;
    std::vector<Open> sections_;
    uint64_t file_size_bytes_ = 0;
};

}  // namespace paim
