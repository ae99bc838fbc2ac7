// Writes .paim files. Layout: docs/format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/magnitude_bounds.h"
#include "paim/format/container/container_writer.h"
#include "paim/format/paim/section_table.h"
#include "paim/format/paim/value_limits.h"

namespace paim {

// Size in bytes of the file that write_paim() writes for this asset. If all values are floats, only
// the dimensions matter, and means and components may be missing.
uint64_t paim_size_bytes(const Asset& asset);

// Writes a .paim of floats whose means and components are given in pieces, so that they are never
// in memory as a whole. The file is written completely or not at all.
class PaimWriter {
  public:
    // asset  without the values of means and components of the moving part
    // Errors name the path: output failed; bad input for numbers that readers would refuse
    // (value_limits.h).
    PaimWriter(const std::filesystem::path& path, const Asset& asset);

    // Appends the next rows of a mean, and the same rows of all components (of unit RMS, rounded
    // here to the matrix's precision).
    void append_rows(Attribute attribute, std::span<const float> mean,
                     std::span<const std::span<const float>> components);

    // The sections of a file of this asset, in order.
    static std::vector<SectionPlan> section_plans(const Asset& asset);

    // Finishes the file. Every mean and component must be complete (checked).
    // Error (bad input): readers would refuse its numbers.
    void commit();

  private:
    struct Layout;
    PaimWriter(const std::filesystem::path& path, const Asset& asset, Layout layout);

    void append(size_t section, std::span<const float> rows, Precision precision);

    // An attribute whose means and components are given in pieces.
    struct Streamed {
        Precision precision;
        size_t mean_section;
        std::vector<size_t> component_sections;
        StreamedMagnitudes magnitudes;
    };

    std::string path_;
    std::vector<Attribute> attributes_;
    std::vector<Streamed> streamed_;  // of each of these
    MagnitudeLimits limits_;
    ContainerWriter writer_;
};

// Writes a .paim. Errors: output failed, naming the path; bad input for numbers that readers would
// refuse (value_limits.h); unsupported if files cannot hold such an asset.
void write_paim(const std::filesystem::path& path, const Asset& asset);

}  // namespace paim
