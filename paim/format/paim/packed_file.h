// Builds a .paim with compressed sections in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/pack/zstd_encoder.h"

namespace paim {

// Whether any value of the asset is an integer, or its codec is always packed. Other files store
// floats uncompressed.
bool needs_packing(const Asset& asset);

class PackedFile {
  public:
    // asset  with all values (shapes are checked)
    // The bytes are the same on any number of threads.
    // Errors: bad input for numbers that readers would refuse (value_limits.h); unsupported for so
    // many values in so small a file that they would refuse it.
    explicit PackedFile(const Asset& asset, Effort effort = Effort::small);

    uint64_t size_bytes() const { return container_size_bytes(plans_); }

    // Writes the file completely or not at all. Errors (output failed) name the path.
    void write(const std::filesystem::path& path) const;

  private:
    void check_expansion(const Asset& asset, uint64_t value_bytes) const;

    std::vector<SectionPlan> plans_;
    std::vector<std::vector<uint8_t>> bytes_;  // of each section
};

}  // namespace paim
