// The model, then the background where there is none.
#include "player/render/scene_renderer.h"

#include <utility>

#include "player/gl/check.h"

namespace paim::player {

namespace {

// The scenery as means without components.
Asset scenery_model(const Asset& model) {
    const Scenery& scenery = model.scenery;
    Asset still;
    still.topology = scenery.topology;
    still.albedo = scenery.albedo;
    still.layout = model.moving().layout;
    const auto matrix = [&](uint32_t num_planes, const StillPlanes& planes) {
        LowRank part;
        part.num_points = scenery.topology.num_vertices;
        part.num_planes = num_planes;
        part.num_poses = model.num_poses();
        part.mean = planes.values;
        part.steps = planes.steps;
        if (!part.mean.holds_floats()) {
            part.precision = part.mean.holds_i8() ? Precision::i8 : Precision::i16;
        }
        return part;
    };
    still.geometry = matrix(3, scenery.positions);
    still.transfer = matrix(model.moving().layout.num_planes(), scenery.transfer);
    return still;
}

}  // namespace

SceneRenderer::SceneRenderer(const Asset& model, const Image& environment,
                             const DecodeLimits& limits) {
    set_model(model, limits);
    set_environment(environment);
}

void SceneRenderer::set_model(const Asset& model, const DecodeLimits& limits) {
    auto model_renderer = std::make_unique<ModelRenderer>(model, limits);
    std::unique_ptr<Asset> scenery;
    std::unique_ptr<ModelRenderer> scenery_renderer;
    if (!model.scenery.empty()) {
        scenery = std::make_unique<Asset>(scenery_model(model));
        scenery_renderer = std::make_unique<ModelRenderer>(*scenery, limits);
    }
    model_renderer_ = std::move(model_renderer);
    scenery_renderer_ = std::move(scenery_renderer);
    scenery_ = std::move(scenery);
    if (environment_ && light_.bands != static_cast<int>(plan().layout.in_bands)) project_light();
}

void SceneRenderer::set_environment(const Image& environment) {
    environment_.emplace(environment);
    project_light();
    background_renderer_.set_environment(environment);
}

void SceneRenderer::project_light() {
    light_ = environment_->coefficients(static_cast<int>(plan().layout.in_bands));
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
    model_renderer_->draw(frame, turned_light_, aspect);
    if (scenery_renderer_) scenery_renderer_->draw(frame, turned_light_, aspect);
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
