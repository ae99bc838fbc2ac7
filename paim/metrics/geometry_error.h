// Errors of decoded positions to the baked ones, in the measures of the mesh compression
// literature.
// Based on: Karni and Gotsman, Compression of Soft-Body Animation Sequences, 2004; Kavan, Sloan and
//           O'Sullivan, Fast and Efficient Skinning of Animated Meshes, 2010
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "paim/metrics/array_error.h"

namespace paim {

// Errors over all poses that are added, each once. Relative errors are infinite if their
// denominator is 0 and the error is not, and 0 if both are. No error is a number if nothing was
// added.
struct GeometryError {
    DistanceError distance;            // RMS and worst, scene units
    double centred_squared_sum = 0.0;  // Σ |p − mean of its pose|², of the reference
    // Largest diagonal of the bounding box of a pose, scene units.
    double diagonal = 0.0;

    double rms() const { return distance.rms(); }  // scene units
    double worst() const;
    double relative_rms() const;  // relative to the diagonal
    double relative_worst() const;

    // 100 √Σ|p − p'|² / √Σ|p − mean of its pose|², percent.
    double kg_error() const;

    // 1000 ‖A − A'‖_F / √(3 V P), with the mesh scaled to a diagonal of 2.
    double e_rms() const;

    // positions, reference  [3][V] planes x, y, z, the same length (checked)
    // num_sized             how many points, from the first, the diagonal is of: a floor under a body
    //                       that travels says nothing of the body's size. 0, or too many: all
    void add(std::span<const float> positions, std::span<const float> reference, uint32_t pose,
             size_t num_sized = 0);
};

}  // namespace paim
