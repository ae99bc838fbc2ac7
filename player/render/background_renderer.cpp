// The environment behind the mesh.
#include "player/render/background_renderer.h"

#include <cmath>

#include "paim/image/area_average.h"
#include "player/gl/check.h"
#include "player/gl/target.h"
#include "player/light/blur_latlong.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

constexpr double kBlur_deg = 8.0;  // standard deviation

void upload(const gl::TextureHandle& texture, const Image& image) {
    glBindTexture(GL_TEXTURE_2D, texture.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, image.width, image.height, 0, GL_RGB, GL_FLOAT,
                 image.pixels.data());
    gl::check_errors("uploading the environment");
}

}  // namespace

BackgroundRenderer::BackgroundRenderer()
    : program_("background", shaders::fullscreen_vert, shaders::background_frag) {
    set_environment(EnvironmentLight(Image(1, 1)));
}

void BackgroundRenderer::set_environment(const EnvironmentLight& environment) {
    const Image& map = environment.image();
    const int max_size = gl::max_texture_size();
    if (map.width > max_size || map.height > max_size) {
        upload(sharp_, fit_latlong(map, max_size, max_size));
    } else if (map.width < kSmoothWidth || map.height < kSmoothHeight) {
        upload(sharp_, smooth_if_small(map));
    } else {
        upload(sharp_, map);
    }
    to_blur_ = environment;
}

void BackgroundRenderer::clear(const Frame& frame) const {
    Vec3f color = frame.background.color;
    if (frame.display) {
        for (float& channel : color) channel = frame.display->apply(channel) / 255.0f;
    }
    gl::clear(color);
}

void BackgroundRenderer::draw(const Frame& frame, float aspect) {
    if (frame.background.kind == Background::Kind::color) return;
    const bool blurred = frame.background.kind == Background::Kind::blurred;
    if (blurred && to_blur_) {
        upload(blurred_, blur_latlong(to_blur_->image(), kBlur_deg));
        to_blur_.reset();
    }
    const float half_height = std::tan(0.5f * frame.camera.vertical_fov_rad);
    const gl::Program& program = program_.use(frame.display);
    program.set("light_axes", Eigen::Matrix3f(frame.environment_from_world * frame.camera.axes()));
    program.set("half_extent", Eigen::Vector2f(half_height * aspect, half_height));
    const PictureRegion& region = frame.region;
    program.set("region_corner", Eigen::Vector2f(region.left, region.bottom));
    program.set("region_size", Eigen::Vector2f(region.width, region.height));
    program.set("strength", frame.environment_strength);
    program.set_texture("environment", 0, blurred ? blurred_ : sharp_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);  // the triangle lies on the far plane, at the depth that was cleared to
    triangle_.draw();
}

}  // namespace paim::player
