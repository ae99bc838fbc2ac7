// Error of an image to a reference.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <cstdint>

#include "paim/image/image.h"

namespace paim {

// Error of linear radiance over the pixels and channels of all images that are added.
struct ImageError {
    double absolute_sum = 0.0;    // Σ |I − I_reference|
    double reference_sum = 0.0;   // Σ |I_reference|
    double squared_sum = 0.0;     // Σ (I − I_reference)²
    uint64_t num_values = 0;      // channels of the pixels where either image is not black
    double reference_peak = 0.0;  // largest |I_reference| of a channel
    double worst = 0.0;           // largest |I − I_reference| of a channel
    int worst_x = 0, worst_y = 0;

    // E6, the paper's visual error: Σ|I_full − I_K| / Σ|I_full|. Not a number where both are 0: in
    // black images nothing is to be seen, and no error was measured.
    double visual_error() const;

    // Root mean square over the values; what is black in both images does not count, so that the
    // number does not depend on how much of the image the mesh fills. Radiance. Not a number where
    // both are black.
    double rmse() const;

    // Peak signal-to-noise ratio, 20 log10(reference_peak / rmse), decibels: infinite without any
    // error, −infinite if the reference is black, not a number where both are black.
    double psnr_db() const;

    void add(const ImageError& other);
};

// The images have the same size (checked).
ImageError compare_images(const Image& image, const Image& reference);

}  // namespace paim
