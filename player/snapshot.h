// One picture into a file, without a display.
#pragma once

#include "player/options.h"
#include "player/scene.h"

namespace paim::player {

// Draws and writes options.snapshot_path; prints what it shows if options.json.
void take_snapshot(const Options& options, const Scene& scene);

}  // namespace paim::player
