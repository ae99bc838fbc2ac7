// Places of the scene and of the model in memory, whose unit of length is another.
#pragma once

#include "paim/base/vector.h"

namespace paim::player {

// scene = model / scale + origin (read_asset.h).
struct SceneUnits {
    double scale = 1.0;
    Vec3d origin = Vec3d::Zero();

    Vec3d to_scene(const Vec3d& model) const { return model / scale + origin; }
    Vec3d to_model(const Vec3d& scene) const { return (scene - origin) * scale; }
};

}  // namespace paim::player
