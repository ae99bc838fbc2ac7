// The built-in light: a clear afternoon sky with a low sun and a dim ground.
#pragma once

#include "paim/image/image.h"

namespace paim {

// A lat-long map of the sky, linear RGB radiance, average radiance about 1, width = 2 · height.
// height_pixels 2 … 4096
Image make_sky(int height_pixels = 128);

}  // namespace paim
