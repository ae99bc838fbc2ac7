// The part of --json that snapshots, clips and benchmarks share.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "player/options.h"
#include "player/presenter.h"
#include "player/scene.h"

namespace paim::player {

// Describes the file, the mesh, the detail in use and its cost, the picture's size and the driver.
// driver  as its context describes itself
nlohmann::ordered_json describe_picture(const Options& options, const Scene& scene,
                                        const Presenter& presenter, const ViewState& view,
                                        const std::string& driver, int samples);

}  // namespace paim::player
