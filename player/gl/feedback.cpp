// Transform feedback of points.
#include "player/gl/feedback.h"

namespace paim::player::gl {

void VertexCapture::run(std::span<const BufferHandle* const> buffers, int num_floats,
                        uint32_t first, uint32_t count) const {
    if (count == 0) return;
    glBindVertexArray(no_attributes_.id());
    glBindBuffer(GL_ARRAY_BUFFER, 0);  // WebGL allows a buffer one use at a time
    const auto stride = static_cast<GLsizeiptr>(static_cast<size_t>(num_floats) * sizeof(GLfloat));
    for (GLuint i = 0; i < buffers.size(); ++i) {
        glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, i, buffers[i]->id(),
                          static_cast<GLintptr>(first) * stride,
                          static_cast<GLsizeiptr>(count) * stride);
    }
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, static_cast<GLint>(first), static_cast<GLsizei>(count));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    for (GLuint i = 0; i < buffers.size(); ++i) {
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, i, 0);
    }
}

}  // namespace paim::player::gl
