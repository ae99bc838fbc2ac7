// Cube maps and angular maps as lat-long maps.
// Based on: OpenEXR, ImfEnvmap.h (faces of cube maps); Debevec, Light Probe Image Gallery, 1998
//           (angular maps)
#pragma once

#include "paim/image/image.h"

namespace paim {

// Both look through the pixels of the map as areas, with radiance interpolated between their
// centres, and average 4 × 4 directions a pixel of the result. The result has about as many pixels
// as the map shows in every direction, 1024 × 512 at least and 4096 × 2048 at most.

// cube  N × 6N pixels (checked): faces +X, −X, +Y, −Y, +Z, −Z from top to bottom
Image latlong_from_cube(const Image& cube);

// probe  N × N pixels (checked)
Image latlong_from_angular(const Image& probe);

// Whether the centre of the pixel lies in the inscribed circle of size × size pixels.
bool is_in_circle(int x, int y, int size);

}  // namespace paim
