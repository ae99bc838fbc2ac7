// A triangle that covers the whole target, on the far plane, for passes over all pixels. Without
// vertex buffers: shaders/fullscreen.vert makes the corners from gl_VertexID.
#pragma once

#include "player/gl/handle.h"

namespace paim::player::gl {

class FullscreenTriangle {
  public:
    void draw() const {
        glBindVertexArray(vertex_array_.id());
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

  private:
    VertexArrayHandle vertex_array_;
};

}  // namespace paim::player::gl
