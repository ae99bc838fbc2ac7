// A current OpenGL context, wherever it comes from: a window or no display at all.
#pragma once

#include <string>

namespace paim::player::gl {

// Current on the thread that made it, for as long as it lives.
class Context {
  public:
    virtual ~Context() = default;

    // The driver's name for what draws, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    std::string renderer() const;

    // Renderer and version, e.g. "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 3.3 (Core Profile) …".
    std::string description() const;
};

// Whether the current context's driver draws on the CPU, as Mesa's llvmpipe and softpipe and
// SwiftShader do.
bool draws_in_software();

// Throws Error(unsupported) unless the current context is OpenGL >= 3.3 or OpenGL ES >= 3.0.
void require_version();

}  // namespace paim::player::gl
