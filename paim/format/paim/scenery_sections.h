// Scenery as sections of a .paim.
#pragma once

#include <vector>

#include "paim/codec/model.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/container_writer.h"

namespace paim {

// Sections of floats (checked once they are filled), or none if the scenery is empty.
std::vector<SectionSpec> scenery_specs(const Scenery& scenery, const TransferLayout& layout);

// Fills the sections of scenery_specs(), which begin with number `first`.
void append_scenery(ContainerWriter& writer, size_t first, const Scenery& scenery);

// Empty if the file has none. Errors (bad input): one of the sections is missing, or shapes,
// indices or numbers make no sense.
Scenery read_scenery(const ContainerReader& reader, const TransferLayout& layout);

}  // namespace paim
