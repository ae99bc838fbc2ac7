// Draws go into a part of the target alone, for as long as this lives.
#pragma once

#include <epoxy/gl.h>

namespace paim::player::gl {

// Set the part with glScissor().
class Scissor {
  public:
    Scissor() { glEnable(GL_SCISSOR_TEST); }
    ~Scissor() { glDisable(GL_SCISSOR_TEST); }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

}  // namespace paim::player::gl
