// OpenGL errors and limits.
#include "player/gl/check.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "paim/base/error.h"

namespace paim::player::gl {

namespace {

std::string error_name(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "invalid enumerant";
        case GL_INVALID_VALUE:
            return "invalid value";
        case GL_INVALID_OPERATION:
            return "invalid operation";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "invalid framebuffer operation";
        case GL_OUT_OF_MEMORY:
            return "out of memory";
        default:
            return fmt::format("error 0x{:04x}", error);
    }
}

// What report_driver_messages() was given last.
std::function<void(std::string_view)> report_message;

void on_driver_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                       const void*) {
    if (type == GL_DEBUG_TYPE_ERROR) report_message(message);
}

int integer(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

}  // namespace

void check_errors(std::string_view doing) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    // Later flags would be blamed on the wrong call; a lost context repeats its error for ever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
    }
    throw_unsupported("OpenGL: {} while {}", error_name(error), doing);
}

void print_driver_message(std::string_view message) {
    fmt::print(stderr, "OpenGL: {}\n", message);
}

void report_driver_messages(std::function<void(std::string_view message)> report) {
    report_message = std::move(report);
    const bool desktop = epoxy_is_desktop_gl();
    if (!epoxy_has_gl_extension("GL_KHR_debug")) return;
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    // The extension's functions have a suffix in OpenGL ES, where they are not in the core.
    if (desktop) {
        glDebugMessageCallback(on_driver_message, nullptr);
    } else {
        glDebugMessageCallbackKHR(on_driver_message, nullptr);
    }
}

int max_texture_size() {
    return integer(GL_MAX_TEXTURE_SIZE);
}

int max_target_size() {
    GLint viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min(
        {max_texture_size(), integer(GL_MAX_RENDERBUFFER_SIZE), viewport[0], viewport[1]});
}

}  // namespace paim::player::gl
