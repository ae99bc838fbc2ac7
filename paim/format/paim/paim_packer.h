// A .paim with compressed sections, put together in memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/model.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/pack/zstd_encoder.h"

namespace paim {

// Whether anything of the model is integers, or clustered. Everything else is written as it is.
bool needs_packing(const Model& model);

class PackedFile {
  public:
    // A whole model (shapes are checked). The same bytes on any number of threads.
    explicit PackedFile(const Model& model, Effort effort = Effort::small);

    uint64_t size_bytes() const { return container_size_bytes(plans_); }

    // All or nothing. Errors (output failed) name the path.
    void write(const std::filesystem::path& path) const;

  private:
    std::vector<SectionPlan> plans_;
    std::vector<std::vector<uint8_t>> bytes_;  // of each section
};

}  // namespace paim
