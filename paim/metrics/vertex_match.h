// Which vertices and planes of a file and of its bake belong together.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/asset.h"

namespace paim {

// [V] the bake's vertex that each of the file's is.
// what  is named in errors: "triangles", "triangles of the still meshes"
// Errors: bad input, naming the bake, if the triangles are others.
std::vector<uint32_t> match_vertices(const Topology& of_file, VertexOrder order,
                                     const Topology& of_bake, const std::string& bake,
                                     const char* what);

// Where a file has this plane of the bake's transfer: nowhere if its bands end before. A grey file has
// one for all channels.
std::optional<uint32_t> plane_of_file(const TransferLayout& of_file, const TransferLayout& of_bake,
                                      uint32_t plane);

// planes [num_planes][V] of the bake, in place in the order of the file.
void reorder_planes(std::span<float> planes, std::span<const uint32_t> old_vertex);

}  // namespace paim
