// Writes a section container completely or not at all. Sections may be filled in any order.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "paim/base/file.h"
#include "paim/base/hash.h"
#include "paim/format/container/container.h"

namespace paim {

// The contents of a section, and the number of its stored bytes.
struct SectionPlan {
    SectionSpec spec;
    SectionCodec codec;
    uint64_t stored_size_bytes;

    // A section whose values are stored as they are.
    SectionPlan(const SectionSpec& as_it_is)
        : spec(as_it_is), codec(SectionCodec::none), stored_size_bytes(as_it_is.size_bytes()) {}
    SectionPlan(const SectionSpec& values, SectionCodec how, uint64_t size_bytes)
        : spec(values), codec(how), stored_size_bytes(size_bytes) {}
};

// Size of the file with these sections.
uint64_t container_size_bytes(std::span<const SectionPlan> plans);

class ContainerWriter {
  public:
    // Lays out all sections, in this order. Errors (output failed) name the path.
    ContainerWriter(const std::filesystem::path& path, Tag kind,
                    const std::vector<SectionPlan>& plans);

    // Appends stored bytes to section number `section` of the plans.
    void append(size_t section, const void* data, size_t size_bytes);

    template <typename T>
    void append(size_t section, std::span<const T> values) {
        append(section, values.data(), values.size_bytes());
    }

    // Finishes the file. Every section must be full (checked).
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
