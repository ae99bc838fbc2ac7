// Transform feedback of points.
#include "player/gl/feedback.h"

namespace paim::player::gl {

void capture_vertices(const BufferHandle& buffer, int num_floats, uint32_t first, uint32_t count) {
    if (count == 0) return;
    // Without attributes: shaders find their data by gl_VertexID.
    const VertexArrayHandle no_attributes;
    glBindVertexArray(no_attributes.id());
    const auto stride = static_cast<GLsizeiptr>(static_cast<size_t>(num_floats) * sizeof(GLfloat));
    glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.id(),
                      static_cast<GLintptr>(first) * stride,
                      static_cast<GLsizeiptr>(count) * stride);
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(count));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

}  // namespace paim::player::gl
