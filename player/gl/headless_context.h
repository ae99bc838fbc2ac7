// An OpenGL context without display, window or GPU, through EGL.
#pragma once

#include <memory>

#include "player/gl/context.h"

namespace paim::player::gl {

enum class Api {
    any,      // desktop OpenGL 3.3 core, else OpenGL ES 3.0
    desktop,  // OpenGL 3.3 core
    es,       // OpenGL ES 3.0
};

// Tries Mesa's surfaceless platform, then every EGL device. Throws Error(unsupported) that says
// what was tried and how it failed.
std::unique_ptr<Context> make_headless_context(Api api = Api::any);

}  // namespace paim::player::gl
