// Triangles, albedo and planes from sections, the same in .paim and .bake.
#pragma once

#include <span>

#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/mesh/topology.h"

namespace paim {

// Errors (bad input): an index that is not below num_vertices, an albedo that is not 1 or
// num_vertices finite colours.
Topology read_triangles(const ContainerReader& reader, uint32_t num_vertices,
                        Tag tag = section::kTriangles);
Albedo read_albedo(const ContainerReader& reader, uint32_t num_vertices,
                   Tag tag = section::kAlbedo);

// All values of an f32 (or f16) section of num_planes × num_vertices finite numbers; anything else
// is an error (bad input).
std::vector<float> read_planes(const ContainerReader& reader, Tag tag, uint32_t num_planes,
                               uint32_t num_vertices, ScalarType type = ScalarType::f32);

// The vertices that a section of positions, [3][V], has: 1 to 2³¹ − 1, anything else is an error
// (bad input).
uint32_t count_vertices(const ContainerReader& reader, Tag tag);

// Error (bad input) naming the file, the section and the place of the first value that is not
// finite; the values are those from `first` on.
void check_finite(const ContainerReader& reader, Tag tag, std::span<const float> values,
                  uint64_t first = 0);

}  // namespace paim
