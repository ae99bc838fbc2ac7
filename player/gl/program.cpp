// Compiling, linking, uniforms.
#include "player/gl/program.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>

#include "paim/base/error.h"

namespace paim::player::gl {

namespace {

// Attached to a program for as long as linking takes.
class Shader {
  public:
    Shader(const std::string& program_name, GLenum stage, std::string_view defines,
           std::string_view source)
        : id_(glCreateShader(stage)) {
        const std::string_view version =
            epoxy_is_desktop_gl() ? "#version 330 core\n" : "#version 300 es\n";
        // Ignored by desktop GLSL; ES gives samplers and fragment floats no high precision by
        // itself.
        const std::string_view precision =
            "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
            "precision highp isampler2D;\n";
        std::string text;
        for (const std::string_view part : {version, precision, defines}) text += part;
        text += "#line 1\n";
        text += source;
        const GLchar* const data = text.data();
        const auto length = static_cast<GLint>(text.size());
        glShaderSource(id_, 1, &data, &length);
        glCompileShader(id_);
        GLint compiled = GL_FALSE;
        glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
        if (compiled == GL_TRUE) return;
        std::array<GLchar, 4096> log{};
        glGetShaderInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
        glDeleteShader(id_);
        throw_unsupported("shader {}, {} stage: the driver refuses it:\n{}", program_name,
                          stage == GL_VERTEX_SHADER ? "vertex" : "fragment", log.data());
    }
    ~Shader() { glDeleteShader(id_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;

    GLuint id() const { return id_; }

  private:
    GLuint id_;
};

}  // namespace

Program::Program(std::string name, std::string_view vertex_source, std::string_view fragment_source,
                 std::string_view defines, std::span<const char* const> captured) {
    const Shader vertex(name, GL_VERTEX_SHADER, defines, vertex_source);
    const Shader fragment(name, GL_FRAGMENT_SHADER, defines, fragment_source);
    glAttachShader(handle_.id(), vertex.id());
    glAttachShader(handle_.id(), fragment.id());
    if (!captured.empty()) {
        glTransformFeedbackVaryings(handle_.id(), static_cast<GLsizei>(captured.size()),
                                    captured.data(), GL_SEPARATE_ATTRIBS);
    }
    glLinkProgram(handle_.id());
    glDetachShader(handle_.id(), vertex.id());
    glDetachShader(handle_.id(), fragment.id());
    GLint linked = GL_FALSE;
    glGetProgramiv(handle_.id(), GL_LINK_STATUS, &linked);
    if (linked == GL_TRUE) return;
    std::array<GLchar, 4096> log{};
    glGetProgramInfoLog(handle_.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw_unsupported("shader {}: the driver does not link it:\n{}", name, log.data());
}

void Program::set(const char* uniform, int value) const {
    glUniform1i(location(uniform), value);
}

void Program::set(const char* uniform, float value) const {
    glUniform1f(location(uniform), value);
}

void Program::set(const char* uniform, const Eigen::Vector2f& value) const {
    glUniform2fv(location(uniform), 1, value.data());
}

void Program::set(const char* uniform, const Eigen::Vector3f& value) const {
    glUniform3fv(location(uniform), 1, value.data());
}

void Program::set(const char* uniform, const Eigen::Vector4f& value) const {
    glUniform4fv(location(uniform), 1, value.data());
}

void Program::set(const char* uniform, const Eigen::Matrix3f& value) const {
    glUniformMatrix3fv(location(uniform), 1, GL_FALSE, value.data());
}

void Program::set(const char* uniform, const glm::mat4& value) const {
    glUniformMatrix4fv(location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::set_texture(const char* sampler, int unit, const TextureHandle& texture) const {
    glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, texture.id());
    set(sampler, unit);
}

}  // namespace paim::player::gl
