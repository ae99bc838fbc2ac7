// The built-in light: a clear afternoon sky with a low sun and a dim ground.
#pragma once

#include "paim/image/image.h"

namespace paim {

// A lat-long map of the sky, linear RGB radiance, width = 2 · height. The average is about 0.4, so
// that light surfaces facing the sun stay just below white at exposure 0. The sun is 28° high, 50°
// from +Z to −X, to the side of the default camera.
// height_pixels 2 … 4096
Image make_sky(int height_pixels = 128);

}  // namespace paim
