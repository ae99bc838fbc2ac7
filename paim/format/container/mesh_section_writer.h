// Writes triangles and albedo as sections of .paim and .bake files.
#pragma once

#include <cstddef>

#include "paim/format/container/container_writer.h"
#include "paim/format/container/sections.h"
#include "paim/mesh/topology.h"

namespace paim {

SectionSpec triangles_spec(const Topology& topology, Tag tag = section::kTriangles);
SectionSpec albedo_spec(const Albedo& albedo, Tag tag = section::kAlbedo);
void append_mesh(ContainerWriter& writer, size_t triangles_section, size_t albedo_section,
                 const Topology& topology, const Albedo& albedo);

}  // namespace paim
