// Pictures of a .paim as it is played, without its bake.
#pragma once

#include <memory>
#include <vector>

#include "analysis/stage.h"
#include "paim/codec/asset.h"
#include "paim/codec/playback.h"

namespace paim {

// Cameras that see all poses of an asset.
class PlayedViews {
  public:
    PlayedViews(const Asset& asset, const StageOptions& options);

    size_t num_views() const { return cameras_.size(); }
    int size_pixels() const { return size_pixels_; }
    // Coordinates are multiplied by it: the camera of a huge scene would be beyond the range of floats.
    float scale() const { return scale_; }
    const std::vector<Camera>& cameras() const { return cameras_; }

  private:
    int size_pixels_;
    float scale_;
    std::vector<Camera> cameras_;  // of the scaled scene
};

class PlayedPictures {
  public:
    // Keeps references to views and lights.
    PlayedPictures(std::shared_ptr<const Asset> asset, const PlayedViews& views,
                   const std::vector<NamedLight>& lights);

    // At a time in poses, against black, with gloss. returns [views · lights + light]
    std::vector<Image> at(double time);

  private:
    // Of all parts, one after another, at the last update.
    std::vector<Vec3f> positions() const;
    std::vector<Vec3f> radiance() const;

    const PlayedViews& views_;
    const std::vector<NamedLight>& lights_;
    Topology topology_;  // of all parts, one after another
    Playback playback_;
};

}  // namespace paim
