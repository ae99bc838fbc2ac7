// Pictures larger than what a driver draws at once, cut into tiles.
#pragma once

#include "player/render/frame.h"

namespace paim::player {

// Equal tiles that cover a picture, in pixels. Those of the last column and row may reach beyond it.
struct Tiling {
    int picture_width, picture_height;
    int tile_width, tile_height;

    int num_columns() const { return (picture_width + tile_width - 1) / tile_width; }
    int num_rows() const { return (picture_height + tile_height - 1) / tile_height; }

    // What a tile shows. Row 0 is at the top.
    PictureRegion region(int column, int row) const;
};

// One tile, if the picture's samples fit into the driver's largest target and are no more than 2^26
// (1.3 GB with depth). Otherwise tiles of at most 4096 x 4096 samples.
// samples          samples × samples for each pixel, 1 … 8
// max_target_size  samples, gl::max_target_size()
Tiling plan_tiles(int width, int height, int samples, int max_target_size);

// The samples per pixel and axis with which a window, which is drawn in one go, fits into the
// driver's largest target: `samples`, or as many as fit, and at least 1.
int samples_that_fit(int width, int height, int samples, int max_target_size);

}  // namespace paim::player
