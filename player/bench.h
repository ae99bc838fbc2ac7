// Times a frame, and the same decoding and shading on the CPU for comparison.
#pragma once

#include "player/options.h"
#include "player/scene.h"

namespace paim::player {

// Draws options.bench_frames frames without a display and prints the times, as JSON if
// options.json.
void run_bench(const Options& options, const Scene& scene);

}  // namespace paim::player
