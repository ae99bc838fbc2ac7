// Reads the sections of a .paim: walks the table of an asset whose dimensions are set.
#pragma once

#include <array>
#include <cstdint>

#include "paim/codec/asset.h"
#include "paim/format/container/container_reader.h"

namespace paim {

// Numbers of components of each attribute.
using ComponentCounts = std::array<uint32_t, kNumAttributes>;

// Fills the asset. The shapes and types of all sections are checked before memory is taken for any.
// counts  components of the moving part to read; the others are skipped
// asset   in: dimensions of the whole file; out: with the components that were read
// Errors (bad input, unsupported) name the file and the section.
void read_sections(const ContainerReader& reader, const ComponentCounts& counts, Asset& asset);

}  // namespace paim
