// The built-in light: a clear afternoon sky with a low sun and a dim ground.
#pragma once

#include "paim/image/image.h"

namespace paim {

// A lat-long map of the sky, linear RGB radiance, width = 2 · height.
// height_pixels  2 … 4096
// note           the average is about 0.7, so that albedo 0.7 facing the sun is just white without
//                exposure; the sun is 24° high, 50° from +Z towards +X
Image make_sky(int height_pixels = 128);

}  // namespace paim
