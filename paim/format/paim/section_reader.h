// Takes the sections of a .paim apart: walks the table of an asset whose dimensions are set.
#pragma once

#include "paim/codec/asset.h"
#include "paim/format/container/container_reader.h"

namespace paim {

// How many components of the part that moves are to be read; all the others are left out.
struct ComponentCounts {
    uint32_t geometry = 0;
    uint32_t transfer = 0;
};

// Fills the asset. Every section's shape and type is checked before memory for any of them is taken.
// asset  dimensions are those of the whole file; afterwards those of the components that were read
// Errors (bad input, unsupported) name the file and the section.
void read_sections(const ContainerReader& reader, const ComponentCounts& counts, Asset& asset);

}  // namespace paim
