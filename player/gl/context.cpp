// What is common to all contexts.
#include "player/gl/context.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <string_view>

#include "paim/base/error.h"

namespace paim::player::gl {

namespace {

constexpr std::string_view kSoftwareRenderers[] = {"llvmpipe", "softpipe", "SWR", "SwiftShader",
                                                   "Software Rasterizer"};

std::string text(GLenum name) {
    const GLubyte* value = glGetString(name);
    return value != nullptr ? reinterpret_cast<const char*>(value) : "unknown";
}

}  // namespace

std::string Context::renderer() const {
    return text(GL_RENDERER);
}

std::string Context::description() const {
    // OpenGL ES already starts its version with its name.
    const std::string api = epoxy_is_desktop_gl() ? "OpenGL " : "";
    return renderer() + ", " + api + text(GL_VERSION);
}

bool draws_in_software() {
    const std::string renderer = text(GL_RENDERER);
    return std::ranges::any_of(kSoftwareRenderers, [&](std::string_view name) {
        return renderer.find(name) != std::string::npos;
    });
}

void require_version() {
    const bool desktop = epoxy_is_desktop_gl();
    const int version = epoxy_gl_version();  // 33 is 3.3
    if (version < (desktop ? 33 : 30)) {
        throw_unsupported("this driver gives {} {}.{} ({}), expected OpenGL 3.3 or OpenGL ES 3.0",
                          desktop ? "OpenGL" : "OpenGL ES", version / 10, version % 10,
                          text(GL_RENDERER));
    }
}

}  // namespace paim::player::gl
