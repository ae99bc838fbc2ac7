// Indices of vertices on the GPU, and drawing some of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "player/gl/handle.h"

namespace paim::player::gl {

// Fills the index buffer of the vertex array that is bound.
// Index  so many 32-bit numbers as a point, line or triangle has corners
template <typename Index>
void upload_indices(const BufferHandle& buffer, const std::vector<Index>& indices) {
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(Index)),
                 indices.data(), GL_STATIC_DRAW);
}

// Draws [first, last) of the array's lines (two corners) or triangles (three).
inline void draw_range(const VertexArrayHandle& array, GLenum mode, size_t corners, size_t first,
                       size_t last) {
    if (first == last) return;
    glBindVertexArray(array.id());
    glDrawElements(mode, static_cast<GLsizei>(corners * (last - first)), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * corners * sizeof(uint32_t)));
}

}  // namespace paim::player::gl
