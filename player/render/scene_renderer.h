// All parts of an asset under a light before their background: all that one frame needs.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/image/image.h"
#include "paim/light/environment.h"
#include "paim/light/light.h"
#include "player/gl/target.h"
#include "player/render/background_renderer.h"
#include "player/render/frame.h"
#include "player/render/mesh_renderer.h"
#include "player/render/tiles.h"

namespace paim::player {

class SceneRenderer {
  public:
    // Keeps a reference to the asset. Nothing beyond the limits is uploaded. Errors (unsupported):
    // the asset does not fit into this driver's textures, or this player does not draw its codec.
    SceneRenderer(const Asset& asset, EnvironmentLight environment, const DecodeLimits& limits);

    // Shows this asset from now on, under the same light, and keeps a reference to it. On an error
    // the old one stays.
    void set_asset(const Asset& asset, const DecodeLimits& limits);

    // Replaces light and background. On an error the old ones stay.
    void set_environment(const EnvironmentLight& environment);

    // What can be shown of the part that moves.
    const UploadPlan& plan() const { return parts_.front()->plan(); }

    // Of all parts.
    uint64_t texture_bytes() const;

    // Draws the whole picture into the target.
    void draw(const Frame& frame, const gl::Target& target);

    // Draws the tiles of a picture one after the other into the target, which has the size of a
    // tile.
    // on_tile  called with column and row after each
    void draw_tiles(const Frame& frame, const Tiling& tiling, const gl::Target& target,
                    const std::function<void(int, int)>& on_tile = {});

    // The picture of width × height pixels, each the mean of samples × samples. Large ones are
    // drawn in tiles (render/tiles.h).
    Image render(const Frame& frame, int width, int height, int samples);

  private:
    void draw(const Frame& frame, const gl::Target& target, float aspect);
    void project_light();

    std::vector<std::unique_ptr<MeshRenderer>> parts_;
    BackgroundRenderer background_renderer_;
    EnvironmentLight environment_;
    LightCoefficients light_;         // not turned
    LightCoefficients turned_light_;  // by turned_rad_
    double turned_rad_ = 0.0;
};

}  // namespace paim::player
