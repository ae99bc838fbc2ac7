// Matches vertices and planes of a file with those of its bake.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/asset.h"

namespace paim {

// The order of triangles that are compared. That of rows of gloss among the faces of a whole mesh is
// another than that of the rows alone.
enum class TriangleOrder { same, any };

// [V] The vertex of the bake for each vertex of the file.
// what  names the triangles in errors: "triangles", "triangles of the still meshes"
// Errors: bad input, naming the bake, if the triangles differ.
std::vector<uint32_t> match_vertices(const Topology& of_file, VertexOrder order,
                                     const Topology& of_bake, const std::string& bake,
                                     const char* what,
                                     TriangleOrder triangles = TriangleOrder::same);

// The plane of the file for this plane of the bake's transfer; nothing if the file does not have
// its bands. A grey file has the same plane for all channels.
std::optional<uint32_t> plane_of_file(const TransferLayout& of_file, const TransferLayout& of_bake,
                                      uint32_t plane);

// Reorders planes of the bake in place, from the order of the bake to that of the file.
// planes  [num_planes][V]
void reorder_planes(std::span<float> planes, std::span<const uint32_t> old_vertex);

}  // namespace paim
