// Blurred environment maps, to be shown behind the mesh.
#pragma once

#include "paim/image/image.h"

namespace paim::player {

constexpr int kBlurredWidth = 256;
constexpr int kBlurredHeight = 128;

// The lat-long map, blurred by a Gaussian of the angle between directions, exp(−angle² / (2 σ²)).
// Pixels count by their solid angle, so that poles and the seam are as smooth as all else. The blur
// works on 128 × 64 pixels at most, fewer for wide Gaussians: two pixels a σ, but 16 × 8 at least.
// There, factors of the rows make it keep constant maps and the mean over all directions (Sinkhorn and
// Knopp, Concerning Nonnegative Matrices and Doubly Stochastic Matrices, 1967). Then
// enlarge_latlong(), which keeps both, too, adds 0.58 of these pixels to the blur.
// sigma_deg  standard deviation in degrees, 0.1 … 90 (checked). Below 2.8 degrees the pixels blur more
//            than the Gaussian.
// map        at least 1 × 1 pixels (checked)
// returns    kBlurredWidth × kBlurredHeight pixels
// cost       1024 × 512 pixels: 3 to 40 ms on two cores, most at 5.6 degrees
Image blur_latlong(const Image& map, double sigma_deg);

// Maps of fewer pixels show them as blocks.
constexpr int kSmoothWidth = 64, kSmoothHeight = 32;

// A map of less than 64 × 32 pixels, made smooth so that no pixel shows as a block; larger ones as they
// are. It is blurred by 0.4 of the larger side of its pixels.
Image smooth_if_small(const Image& map);

}  // namespace paim::player
