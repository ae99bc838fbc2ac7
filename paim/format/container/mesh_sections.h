// Reads triangles, albedo and planes from sections of .paim and .bake files.
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

// Reads an f32 (or f16) section of num_planes × num_vertices finite numbers. Error (bad input) if
// the section is anything else.
std::vector<float> read_planes(const ContainerReader& reader, Tag tag, uint32_t num_planes,
                               uint32_t num_vertices, ScalarType type = ScalarType::f32);

// Number of vertices of a section of positions, [3][V]. Error (bad input) if it is not in 1 … 2³¹ −
// 1.
uint32_t count_vertices(const ContainerReader& reader, Tag tag);

// Error (bad input) if a value is not finite. It names the file, the section and the number of the
// first such value, counted from `first`.
void check_finite(const ContainerReader& reader, Tag tag, std::span<const float> values,
                  uint64_t first = 0);

}  // namespace paim
