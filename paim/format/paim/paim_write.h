// Writes .paim files. Layout: docs/format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/paim/section_table.h"

namespace paim {

// Size in bytes of the file that write_paim() makes of an asset with these dimensions; where all values
// are floats, the values of means and components do not matter and may be missing.
uint64_t paim_size_bytes(const Asset& asset);

// Writes a .paim of floats whose means and components arrive in pieces, so that they need never be in
// memory as a whole. All or nothing.
class PaimWriter {
  public:
    // asset  everything but the means and components of the part that moves
    // Errors (output failed) name the path.
    PaimWriter(const std::filesystem::path& path, const Asset& asset);

    // The next rows of a mean, or of a component (unit RMS; rounded to the matrix's precision here).
    void append_mean(Attribute attribute, std::span<const float> rows);
    void append_component(ComponentId id, std::span<const float> rows);

    // The sections that a file of this asset has, in order.
    static std::vector<SectionPlan> section_plans(const Asset& asset);

    // Every mean and component must be complete by now (checked).
    void commit() { writer_.commit(); }

  private:
    struct Layout;
    PaimWriter(const std::filesystem::path& path, const Asset& asset, Layout layout);

    Precision precision_[2];
    size_t mean_section_[2];
    std::vector<size_t> component_section_[2];
    ContainerWriter writer_;
};

// Errors (output failed) name the path; unsupported: files have no place for such an asset.
void write_paim(const std::filesystem::path& path, const Asset& asset);

}  // namespace paim
