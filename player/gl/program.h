// A shader program from GLSL source in the common subset of GLSL 3.30 and GLSL ES 3.00.
#pragma once

#include <Eigen/Core>

#include <glm/mat4x4.hpp>
#include <span>
#include <string>
#include <string_view>

#include "player/gl/handle.h"

namespace paim::player::gl {

class Program {
  public:
    // The sources have no #version line: the one that fits the current context is put before them.
    // Throws Error(unsupported) with `name`, the stage and the driver's log.
    // defines   #define lines for both, each with its line end
    // captured  the outputs of the vertex shader that transform feedback keeps (gl/feedback.h)
    Program(std::string name, std::string_view vertex_source, std::string_view fragment_source,
            std::string_view defines = {}, std::span<const char* const> captured = {});

    void use() const { glUseProgram(handle_.id()); }

    // Uniforms of the program, which must be in use. A name that the compiler optimised away is
    // ignored.
    void set(const char* uniform, int value) const;
    void set(const char* uniform, float value) const;
    void set(const char* uniform, const Eigen::Vector2f& value) const;
    void set(const char* uniform, const Eigen::Vector3f& value) const;
    void set(const char* uniform, const Eigen::Vector4f& value) const;
    void set(const char* uniform, const Eigen::Matrix3f& value) const;
    void set(const char* uniform, const glm::mat4& value) const;

    // Binds a 2D texture to the unit and hands the unit to the sampler.
    void set_texture(const char* sampler, int unit, const TextureHandle& texture) const;

  private:
    GLint location(const char* uniform) const {
        return glGetUniformLocation(handle_.id(), uniform);
    }

    ProgramHandle handle_;
};

}  // namespace paim::player::gl
