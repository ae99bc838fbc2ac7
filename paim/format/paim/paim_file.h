// The .paim file: a compressed animation. Layout: docs/format.md.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "paim/codec/model.h"
#include "paim/format/container/container_writer.h"

namespace paim {

struct ComponentId {
    Attribute attribute;
    uint32_t k;
    bool operator==(const ComponentId&) const = default;
};

// The order of components in a file: by the share of their part's energy, largest first, so that
// every prefix is the best coarser animation of its size.
std::vector<ComponentId> component_order(const Model& model);

// Size in bytes of the file that write_paim() makes of a model with these dimensions; what the
// model's mean and components hold does not matter.
uint64_t paim_size_bytes(const Model& model);

// Writes a .paim whose means and components arrive in pieces, so that they need never be in memory
// as a whole. All or nothing.
class PaimWriter {
  public:
    // `model` holds everything but the means and components, which may be empty; the scenery is
    // whole.
    // Errors (output failed) name the path.
    PaimWriter(const std::filesystem::path& path, const Model& model);

    // The next rows of a mean, or of a component (unit RMS; rounded to the part's precision here).
    void append_mean(Attribute attribute, std::span<const float> rows);
    void append_component(ComponentId id, std::span<const float> rows);

    // The sections that a file of this model has, in order.
    static std::vector<SectionPlan> section_plans(const Model& model);

    // Every mean and component must be complete by now (checked).
    void commit() { writer_.commit(); }

  private:
    struct Index;
    Precision precision_[2];
    size_t mean_section_[2];
    std::vector<size_t> component_section_[2];
    ContainerWriter writer_;

    PaimWriter(const std::filesystem::path& path, const Model& model, Index index);
};

// Errors (output failed) name the path.
void write_paim(const std::filesystem::path& path, const Model& model);

struct ReadOptions {
    // Take a file of which only the beginning is there, as while it is being loaded: a model with
    // the components that are there (Model::complete, format/paim/prefixes.h).
    bool progressive = false;
};

// Errors (bad input, unsupported) name the file and what is wrong; indices, shapes and numbers are
// checked, so that a model that is returned can be played. What is not there is an error: of a file
// that is read progressively all but the components, and the message says how many bytes that takes.
Model read_paim(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace paim
