// The window: plays, listens to keys and mouse, shows what it costs.
#pragma once

#include "player/options.h"
#include "player/scene.h"

namespace paim::player {

// Returns when the window is closed, or after options.window_frames frames. Throws
// Error(unsupported) where there is no display, which says to use --snapshot.
void run_app(const Options& options, const Scene& scene);

}  // namespace paim::player
