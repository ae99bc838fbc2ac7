// Lat-long maps of few pixels, enlarged without blocks.
// Based on: Unser, Splines: A Perfect Fit for Signal and Image Processing, 1999 (cubic B-splines)
#pragma once

#include "paim/image/image.h"

namespace paim::player {

// The map as a surface of cubic B-splines over longitude and latitude, at the centres of the pixels of
// the result. The splines wrap at the seam, and behind a pole they go on at the opposite longitude.
// Along a meridian they are rational, with weights of the rows that make every row keep its share of
// the mean over all directions. So constants and means stay as they are (to rounding), and a value
// never leaves the range of the 16 pixels about it: no bright light makes dark rings. The splines blur
// by a standard deviation of 0.58 pixels of the map.
// map            at least 1 × 1 pixels (checked)
// width, height  of the result in pixels, at least those of the map (checked)
Image enlarge_latlong(const Image& map, int width, int height);

}  // namespace paim::player
