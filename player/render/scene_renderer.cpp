// All parts, then the background where there is none.
#include "player/render/scene_renderer.h"

#include <utility>

#include "player/gl/check.h"

namespace paim::player {

SceneRenderer::SceneRenderer(const Asset& asset, EnvironmentLight environment,
                             const DecodeLimits& limits)
    : environment_(std::move(environment)) {
    set_asset(asset, limits);
    background_renderer_.set_environment(environment_.image());
}

void SceneRenderer::set_asset(const Asset& asset, const DecodeLimits& limits) {
    std::vector<std::unique_ptr<MeshRenderer>> parts;
    for (const CodedMesh& mesh : asset.parts) {
        parts.push_back(std::make_unique<MeshRenderer>(mesh, limits));
    }
    parts_ = std::move(parts);
    if (light_.bands != static_cast<int>(plan().layout.in_bands)) project_light();
}

uint64_t SceneRenderer::texture_bytes() const {
    uint64_t bytes = 0;
    for (const auto& part : parts_) bytes += part->texture_bytes();
    return bytes;
}

void SceneRenderer::set_environment(const EnvironmentLight& environment) {
    background_renderer_.set_environment(environment.image());
    environment_ = environment;
    project_light();
}

void SceneRenderer::project_light() {
    light_ = environment_.coefficients(static_cast<int>(plan().layout.in_bands));
    turned_light_ = light_;
    turned_rad_ = 0.0;
}

void SceneRenderer::draw(const Frame& frame, const gl::Target& target) {
    if (frame.env_rotation_rad != turned_rad_) {
        turned_light_ = turn_about_y(light_, frame.env_rotation_rad);
        turned_rad_ = frame.env_rotation_rad;
    }
    const float aspect = static_cast<float>(target.width()) / static_cast<float>(target.height());
    target.bind();
    background_renderer_.clear(frame);
    for (const auto& part : parts_) part->draw(frame, turned_light_, aspect);
    background_renderer_.draw(frame, aspect);
}

Image SceneRenderer::render(const Frame& frame, int width, int height, int samples) {
    const gl::Target target(width * samples, height * samples);
    draw(frame, target);
    gl::check_errors("drawing");
    Image image = target.read();
    return samples == 1 ? image : downsample(image, samples);
}

}  // namespace paim::player
