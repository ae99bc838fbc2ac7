// The environment behind the mesh.
#include "player/render/background_renderer.h"

#include <algorithm>
#include <cmath>

#include "player/gl/check.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

// Averages blocks of factor × factor pixels; those at the right and lower edges may be smaller.
Image reduce(const Image& image, int factor) {
    Image reduced((image.width + factor - 1) / factor, (image.height + factor - 1) / factor);
    for (int y = 0; y < reduced.height; ++y) {
        for (int x = 0; x < reduced.width; ++x) {
            const int right = std::min(image.width, (x + 1) * factor);
            const int bottom = std::min(image.height, (y + 1) * factor);
            Vec3d sum = Vec3d::Zero();
            for (int from_y = y * factor; from_y < bottom; ++from_y) {
                for (int from_x = x * factor; from_x < right; ++from_x) {
                    sum += image.at(from_x, from_y).cast<double>();
                }
            }
            const int count = (right - x * factor) * (bottom - y * factor);
            reduced.at(x, y) = (sum / count).cast<float>();
        }
    }
    return reduced;
}

}  // namespace

BackgroundRenderer::BackgroundRenderer()
    : program_("background", shaders::fullscreen_vert, shaders::background_frag) {
    set_environment(Image(1, 1));
}

void BackgroundRenderer::set_environment(const Image& image) {
    const int max_size = gl::max_texture_size();
    const int factor = (std::max(image.width, image.height) + max_size - 1) / max_size;
    if (factor > 1) {
        set_environment(reduce(image, factor));
        return;
    }
    glBindTexture(GL_TEXTURE_2D, environment_.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, image.width, image.height, 0, GL_RGB, GL_FLOAT,
                 image.pixels.data());
    gl::check_errors("uploading the environment");
}

void BackgroundRenderer::clear(const Frame& frame) const {
    const Vec3f& color = frame.background.color;
    glClearColor(color[0], color[1], color[2], 1.0f);
    glClearDepthf(1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void BackgroundRenderer::draw(const Frame& frame, float aspect) const {
    if (frame.background.kind != Background::Kind::environment) return;
    // The map turns by the angle, so directions are looked up turned back by it.
    const Eigen::Matrix3f light_from_world =
        Eigen::AngleAxisf(static_cast<float>(-frame.env_rotation_rad), Vec3f::UnitY())
            .toRotationMatrix();
    const float half_height = std::tan(0.5f * frame.camera.vertical_fov_rad);
    program_.use();
    program_.set("light_axes", Eigen::Matrix3f(light_from_world * frame.camera.axes()));
    program_.set("half_extent", Eigen::Vector2f(half_height * aspect, half_height));
    program_.set_texture("environment", 0, environment_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);  // the triangle lies on the far plane, at the depth that was cleared to
    triangle_.draw();
}

}  // namespace paim::player
