// Triangles and albedo as sections, the same in .paim and .bake.
#pragma once

#include <span>

#include "paim/format/container_reader.h"
#include "paim/format/container_writer.h"
#include "paim/mesh/topology.h"

namespace paim {

SectionSpec triangles_spec(const Topology& topology);
SectionSpec albedo_spec(const Albedo& albedo);
void append_mesh(ContainerWriter& writer, size_t triangles_section, size_t albedo_section,
                 const Topology& topology, const Albedo& albedo);

// Errors (bad input): an index that is not below num_vertices, an albedo that is not 1 or
// num_vertices finite colours.
Topology read_triangles(const ContainerReader& reader, uint32_t num_vertices);
Albedo read_albedo(const ContainerReader& reader, uint32_t num_vertices);

// Error (bad input) naming the file, the section and the place of the first value that is not
// finite; the values are those from `first` on.
void check_finite(const ContainerReader& reader, Tag tag, std::span<const float> values,
                  uint64_t first = 0);

}  // namespace paim
