// Ownership of OpenGL objects: made when constructed, deleted with the handle, moved but not
// copied. A handle must not outlive the context that was current when it was made.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace paim::player::gl {

// Traits: static GLuint create(); static void destroy(GLuint).
template <typename Traits>
class Handle {
  public:
    Handle() : id_(Traits::create()) {}
    ~Handle() { reset(); }
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
        }
        return *this;
    }

    GLuint id() const { return id_; }

  private:
    void reset() {
        if (id_ != 0) Traits::destroy(id_);
        id_ = 0;
    }

    GLuint id_ = 0;
};

struct TextureTraits {
    static GLuint create() {
        GLuint id = 0;
        glGenTextures(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};

struct BufferTraits {
    static GLuint create() {
        GLuint id = 0;
        glGenBuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};

struct VertexArrayTraits {
    static GLuint create() {
        GLuint id = 0;
        glGenVertexArrays(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};

struct FramebufferTraits {
    static GLuint create() {
        GLuint id = 0;
        glGenFramebuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};

struct RenderbufferTraits {
    static GLuint create() {
        GLuint id = 0;
        glGenRenderbuffers(1, &id);
        return id;
    }
    static void destroy(GLuint id) { glDeleteRenderbuffers(1, &id); }
};

struct ProgramTraits {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint id) { glDeleteProgram(id); }
};

using TextureHandle = Handle<TextureTraits>;
using BufferHandle = Handle<BufferTraits>;
using VertexArrayHandle = Handle<VertexArrayTraits>;
using FramebufferHandle = Handle<FramebufferTraits>;
using RenderbufferHandle = Handle<RenderbufferTraits>;
using ProgramHandle = Handle<ProgramTraits>;

}  // namespace paim::player::gl
