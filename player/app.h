// The window: plays, listens to keys and mouse, shows what it costs.
#pragma once

#include "player/options.h"
#include "player/scene.h"

namespace paim::player {

// Returns when the window is closed, or after options.window_frames frames. Throws
// Error(unsupported) where there is no display, which says to use --snapshot.
void run_app(const Options& options, Scene scene);

// Plays a file that is large, or with options.play_prefix one that is still being written. Waits, with
// a note on stderr, for a prefix of it that can be played; shows more detail when a longer one has been
// read. Errors as load_scene()'s and PrefixLoader's; a damaged file that should be whole closes the
// window.
void run_app_from_prefix(Options& options);

}  // namespace paim::player
