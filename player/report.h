// The part of --json that snapshots and benchmarks share.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "player/options.h"
#include "player/scene.h"

namespace paim::player {

// File, mesh, what of it is in use and what that costs, picture size, renderer.
nlohmann::ordered_json describe_frame(const Options& options, const Scene& scene,
                                      const std::string& renderer, int samples);

// The first frame that the options ask for.
Frame first_frame(const Options& options, const Scene& scene);

}  // namespace paim::player
