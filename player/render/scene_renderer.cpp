// All parts, then the background where there is none.
#include "player/render/scene_renderer.h"

#include <algorithm>
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
    draw(frame, target, static_cast<float>(target.width()) / static_cast<float>(target.height()));
}

void SceneRenderer::draw(const Frame& frame, const gl::Target& target, float aspect) {
    if (frame.env_rotation_rad != turned_rad_) {
        turned_light_ = turn_about_y(light_, frame.env_rotation_rad);
        turned_rad_ = frame.env_rotation_rad;
    }
    target.bind();
    background_renderer_.clear(frame);
    for (const auto& part : parts_) part->draw(frame, turned_light_, aspect);
    background_renderer_.draw(frame, aspect);
}

void SceneRenderer::draw_tiles(const Frame& frame, const Tiling& tiling, const gl::Target& target,
                               const std::function<void(int, int)>& on_tile) {
    const float aspect =
        static_cast<float>(tiling.picture_width) / static_cast<float>(tiling.picture_height);
    Frame of_tile = frame;
    for (int row = 0; row < tiling.num_rows(); ++row) {
        for (int column = 0; column < tiling.num_columns(); ++column) {
            of_tile.region = tiling.region(column, row);
            draw(of_tile, target, aspect);
            if (on_tile) on_tile(column, row);
        }
    }
}

Image SceneRenderer::render(const Frame& frame, int width, int height, int samples) {
    const Tiling tiling = plan_tiles(width, height, samples, gl::max_target_size());
    const gl::Target target(tiling.tile_width * samples, tiling.tile_height * samples);
    const auto read = [&] {
        gl::check_errors("drawing");
        Image image = target.read();
        return samples == 1 ? image : downsample(image, samples);
    };
    if (tiling.num_columns() == 1 && tiling.num_rows() == 1) {
        draw(frame, target);
        return read();
    }
    Image picture(width, height);
    draw_tiles(frame, tiling, target, [&](int column, int row) {
        const Image tile = read();
        const int left = column * tile.width, top = row * tile.height;
        for (int y = 0; y < std::min(tile.height, height - top); ++y) {
            for (int x = 0; x < std::min(tile.width, width - left); ++x) {
                picture.at(left + x, top + y) = tile.at(x, y);
            }
        }
    });
    return picture;
}

}  // namespace paim::player
