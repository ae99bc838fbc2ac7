// A slow reference picture: one ray through the centre of each pixel, against every triangle.
// Based on: Möller and Trumbore, Fast, Minimum Storage Ray-Triangle Intersection, 1997
#pragma once

#include <vector>

#include "paim/image/image.h"
#include "paim/mesh/topology.h"
#include "paim/shade/camera.h"

namespace paim::player {

// values  [V] what the vertices show, interpolated over triangles
Image ray_cast(const Topology& topology, const std::vector<Vec3f>& positions,
               const std::vector<Vec3f>& values, const Camera& camera, int width, int height,
               const Vec3f& background);

struct Difference {
    double mean_relative = 0.0;  // Σ|a − b| / Σ|a|
    double fraction_off = 0.0;   // pixels with a channel off by more than 2/255
};

Difference compare(const Image& reference, const Image& image);

}  // namespace paim::player
