// All instances of all parts of an asset before their background: all that one frame needs.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/image/image.h"
#include "paim/light/environment.h"
#include "player/gl/target.h"
#include "player/render/background_renderer.h"
#include "player/render/frame.h"
#include "player/render/surface_mesh.h"
#include "player/render/surface_renderer.h"
#include "player/render/textured_faces.h"
#include "player/render/tiles.h"
#include "player/render/vertex_source.h"

namespace paim::player {

class SceneRenderer {
  public:
    // Nothing beyond the limits is uploaded, or beyond `fewer` if that is too much for this driver.
    // Errors: those of make_vertex_source().
    SceneRenderer(std::shared_ptr<const Asset> asset, const DecodeLimits& limits,
                  const DecodeLimits& fewer, Decoder decoder);

    // Shows this asset from now on. On an error the old one stays.
    void set_asset(std::shared_ptr<const Asset> asset, const DecodeLimits& limits,
                   const DecodeLimits& fewer);

    // The map behind the meshes, at first black (BackgroundRenderer::set_environment()).
    void set_environment(const EnvironmentLight& environment) {
        background_renderer_.set_environment(environment);
    }

    // What can be shown at most of the part that moves.
    DecodeLimits most() const { return vertices_->most(); }
    // Of all textures that hold the asset, and of all vertices and triangles.
    uint64_t texture_bytes() const;
    uint64_t buffer_bytes() const;
    bool decodes_on_cpu() const { return vertices_->is_on_cpu(); }
    // Why the CPU decodes although shaders were to; empty if they do, or were not to.
    const std::string& decoder_note() const { return decoder_note_; }

    // Draws the whole picture into the target.
    void draw(const Frame& frame, const gl::Target& target);

    // Draws what the frame's region shows over what the current target holds.
    // aspect  of the whole picture
    void draw(const Frame& frame, float aspect);

    // Draws the tiles of a picture one after the other into the target, which has the size of a
    // tile.
    // on_tile  called with column and row after each
    void draw_tiles(const Frame& frame, const Tiling& tiling, const gl::Target& target,
                    const std::function<void(int, int)>& on_tile = {});

    // The picture of width × height pixels, each the mean of samples × samples. Large ones are
    // drawn in tiles (render/tiles.h).
    Image render(const Frame& frame, int width, int height, int samples);

  private:
    // The images of a part, those that are there already if the new asset has the same.
    std::shared_ptr<const ImageTextures> images_of(const Asset& asset, size_t part) const;
    void draw_instance(const Frame& frame, const Instance& instance, float aspect);

    Decoder decoder_;
    std::string decoder_note_;
    std::shared_ptr<const Asset> asset_;
    std::unique_ptr<VertexSource> vertices_;
    std::vector<SurfaceMesh> surfaces_;                   // one for each part
    std::vector<std::optional<TexturedFaces>> textured_;  // of parts that have a texture
    std::vector<size_t> num_following_;  // of each part: triangles before those of a floor
    SurfaceRenderer surface_renderer_;
    BackgroundRenderer background_renderer_;
};

}  // namespace paim::player
