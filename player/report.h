// The part of --json that snapshots and benchmarks share.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "player/options.h"
#include "player/render/scene_renderer.h"
#include "player/scene.h"

namespace paim::player {

// Describes the file, the mesh, the detail in use and its cost, the picture's size and the driver.
// driver  as its context describes itself
nlohmann::ordered_json describe_frame(const Options& options, const Scene& scene,
                                      const SceneRenderer& renderer, const std::string& driver,
                                      int samples);

// Lights the frame by the scene's environment, turned about +Y.
void set_light(Frame& frame, const Scene& scene, double env_rotation_rad);

// The first frame that the options ask for.
Frame first_frame(const Options& options, const Scene& scene);

}  // namespace paim::player
