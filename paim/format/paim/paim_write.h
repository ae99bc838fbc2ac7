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

// Size in bytes of the file that write_paim() writes for this asset. If all values are floats, only
// the dimensions matter, and means and components may be missing.
uint64_t paim_size_bytes(const Asset& asset);

// Writes a .paim of floats whose means and components are given in pieces, so that they are never
// in memory as a whole. The file is written completely or not at all.
class PaimWriter {
  public:
    // asset  without the values of means and components of the moving part
    // Errors (output failed) name the path.
    PaimWriter(const std::filesystem::path& path, const Asset& asset);

    // Appends rows of a mean, or of a component (of unit RMS, rounded here to the matrix's
    // precision).
    void append_mean(Attribute attribute, std::span<const float> rows);
    void append_component(ComponentId id, std::span<const float> rows);

    // The sections of a file of this asset, in order.
    static std::vector<SectionPlan> section_plans(const Asset& asset);

    // Finishes the file. Every mean and component must be complete (checked).
    void commit() { writer_.commit(); }

  private:
    struct Layout;
    PaimWriter(const std::filesystem::path& path, const Asset& asset, Layout layout);

    Precision precision_[2];
    size_t mean_section_[2];
    std::vector<size_t> component_section_[2];
    ContainerWriter writer_;
};

// Writes a .paim. Errors: output failed, naming the path; unsupported if files cannot hold such an
// asset.
void write_paim(const std::filesystem::path& path, const Asset& asset);

}  // namespace paim
