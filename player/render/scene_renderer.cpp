// All parts, then the background where there is none.
#include "player/render/scene_renderer.h"

#include <algorithm>
#include <utility>

#include "player/gl/check.h"

namespace paim::player {

SceneRenderer::SceneRenderer(std::shared_ptr<const Asset> asset, const DecodeLimits& limits,
                             const DecodeLimits& fewer, Decoder decoder)
    : decoder_(decoder) {
    set_asset(std::move(asset), limits, fewer);
}

void SceneRenderer::set_asset(std::shared_ptr<const Asset> asset, const DecodeLimits& limits,
                              const DecodeLimits& fewer) {
    std::string note;
    auto vertices = make_vertex_source(asset, limits, fewer, decoder_, note);
    std::vector<SurfaceMesh> surfaces;
    std::vector<size_t> num_following;
    for (const CodedMesh& mesh : asset->parts) {
        surfaces.emplace_back(mesh);
        num_following.push_back(mesh.topology.num_triangles_before(mesh.num_following));
    }
    std::vector<std::optional<TexturedFaces>> textured(surfaces.size());
    for (size_t j = 0; j < surfaces.size(); ++j) {
        if (!surfaces[j].has_white_radiance()) continue;
        textured[j].emplace(asset->parts[j], surfaces[j], images_of(*asset, j));
    }
    vertices_ = std::move(vertices);
    surfaces_ = std::move(surfaces);
    textured_ = std::move(textured);
    num_following_ = std::move(num_following);
    asset_ = std::move(asset);
    decoder_note_ = std::move(note);
}

std::shared_ptr<const ImageTextures> SceneRenderer::images_of(const Asset& asset,
                                                              size_t part) const {
    const Texture& texture = asset.parts[part].texture;
    if (part < textured_.size() && textured_[part]) {
        const Texture& before = asset_->parts[part].texture;
        if (before.images == texture.images && before.factors == texture.factors) {
            return textured_[part]->images();
        }
    }
    return std::make_shared<const ImageTextures>(texture);
}

uint64_t SceneRenderer::texture_bytes() const {
    uint64_t bytes = vertices_->texture_bytes();
    for (const auto& textured : textured_) bytes += textured ? textured->texture_bytes() : 0;
    for (const SurfaceMesh& surface : surfaces_) {
        bytes += surface.gloss() != nullptr ? surface.gloss()->texture_bytes() : 0;
    }
    return bytes;
}

uint64_t SceneRenderer::buffer_bytes() const {
    uint64_t bytes = 0;
    for (const SurfaceMesh& surface : surfaces_) bytes += surface.buffer_bytes();
    for (const auto& textured : textured_) bytes += textured ? textured->buffer_bytes() : 0;
    return bytes;
}

void SceneRenderer::draw(const Frame& frame, const gl::Target& target) {
    target.bind();
    draw(frame, static_cast<float>(target.width()) / static_cast<float>(target.height()));
}

void SceneRenderer::draw(const Frame& frame, float aspect) {
    background_renderer_.clear(frame);
    for (const Instance& instance : frame.instances) draw_instance(frame, instance, aspect);
    background_renderer_.draw(frame, aspect);
}

void SceneRenderer::draw_instance(const Frame& frame, const Instance& instance, float aspect) {
    const double time = time_of(frame, instance, asset_->num_poses());
    vertices_->update(time, frame.limits, frame.colors ? nullptr : &frame.light,
                      frame.gloss != GlossDetail::none, surfaces_);
    if (frame.colors) {
        const PartColors& colors = frame.colors(time);
        vertices_->forget_colors();
        for (size_t j = 0; j < surfaces_.size(); ++j) surfaces_[j].upload_colors(colors[j]);
    }
    for (size_t j = 0; j < surfaces_.size(); ++j) {
        const CodedMesh& mesh = asset_->parts[j];
        // What stands still around the animation is there once.
        const bool is_copy = &instance != &frame.instances.front();
        if (is_copy && j > 0) continue;
        const SurfacePlace place{num_following_[j], root_at(mesh.root_motion, time),
                                 instance.offset};
        // Colours to show instead of radiance are those of vertices.
        const bool with_images = frame.textures && !frame.colors && textured_[j];
        surface_renderer_.draw(surfaces_[j], mesh.topology.triangles.size(), place, frame, aspect,
                               with_images ? &*textured_[j] : nullptr);
    }
}

void SceneRenderer::draw_tiles(const Frame& frame, const Tiling& tiling, const gl::Target& target,
                               const std::function<void(int, int)>& on_tile) {
    const float aspect =
        static_cast<float>(tiling.picture_width) / static_cast<float>(tiling.picture_height);
    Frame of_tile = frame;
    for (int row = 0; row < tiling.num_rows(); ++row) {
        for (int column = 0; column < tiling.num_columns(); ++column) {
            of_tile.region = tiling.region(column, row);
            target.bind();
            draw(of_tile, aspect);
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
