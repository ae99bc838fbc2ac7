// Which vertex of a bake each vertex of a file is.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/model.h"

namespace paim {

// [V] the bake's vertex that each of the file's is.
// what  is named in errors: "triangles", "triangles of the scenery"
// Errors: bad input, naming the bake, if the triangles are others.
std::vector<uint32_t> match_vertices(const Topology& of_file, VertexOrder order,
                                     const Topology& of_bake, const std::string& bake,
                                     const char* what);

// planes [num_planes][V] of the bake, in place in the order of the file.
void reorder_planes(std::span<float> planes, std::span<const uint32_t> old_vertex);

}  // namespace paim
