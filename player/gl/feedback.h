// Transform feedback: keeps what a vertex shader computes, in buffers, and draws nothing.
#pragma once

#include <cstdint>
#include <span>

#include "player/gl/handle.h"
#include "player/gl/program.h"

namespace paim::player::gl {

class VertexCapture {
  public:
    // Runs the program's vertex shader once for each vertex first … first + count − 1 (gl_VertexID) and
    // writes the outputs that the program captures, num_floats 32-bit floats a vertex each, to their
    // places in the buffers: vertex v at v · num_floats. The program is in use, and captures as many
    // outputs as there are buffers.
    void run(std::span<const BufferHandle* const> buffers, int num_floats, uint32_t first,
             uint32_t count) const;

  private:
    VertexArrayHandle no_attributes_;  // shaders find their data by gl_VertexID
};

}  // namespace paim::player::gl
