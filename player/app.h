// The window: plays, listens to keys and mouse, shows what it costs.
#pragma once

#include "player/options.h"
#include "player/scene.h"

namespace paim::player {

// Returns when the window is closed, or after options.window_frames frames. Throws
// Error(unsupported) where there is no display, which says to use --snapshot.
void run_app(const Options& options, Scene scene);

// The same of a file that is still being written: starts with the beginning that can be played, for
// which it waits, with a note on stderr, and shows more as it comes. Errors as load_scene()'s and
// ProgressiveLoader's.
void run_growing(Options& options);

}  // namespace paim::player
