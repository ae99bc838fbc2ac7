// Error curves: what components and bands cost in accuracy and save in bytes and time.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paim/codec/mesh_decoder.h"
#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/image/image.h"
#include "paim/metrics/array_error.h"

namespace paim {

// One setting of one curve: what is known beforehand, and what is measured (measure.h).
struct CurvePoint {
    uint32_t value = 0;  // components or bands kept
    bool all = false;    // whether that is all there are
    DecodeLimits limits;
    double theory_error = 0.0;  // E5
    double energy_error = 0.0;
    uint64_t size_bytes = 0;  // of the .paim with this setting, all else kept

    std::vector<double> visual_error;  // [lights] E6 over all measured poses
    DistanceError distance;            // of positions from the bake's
    ArrayError transfer;               // from the bake's; what is dropped counts as zero
    double decode_ms = 0.0;            // to rebuild one pose on the CPU, median over measured poses
    std::vector<Image> images;         // [lights] of the first measured pose
};

struct Curve {
    std::string name;                // "geometry_components", "transfer_components", "bands"
    std::string title;               // for people
    std::vector<CurvePoint> points;  // from all downwards
    // What every setting would lose, by theory: [0 … all]
    std::vector<double> theory_errors;
    std::vector<double> energy_errors;
};

// Norm of each coefficient over vertices, channels and poses, [bands²]: what plays the part of
// singular values where bands are dropped (docs/metrics.md).
std::vector<double> coefficient_norms(const BakeReader& bake);

// The three curves of the paper, not measured yet: all there is, then those of the asked-for
// components and bands that are less. The asset holds all components in f32.
std::vector<Curve> plan_curves(const BakeReader& bake, const Asset& asset,
                               const std::vector<uint32_t>& components,
                               const std::vector<uint32_t>& bands);

size_t num_points(const std::vector<Curve>& curves);

}  // namespace paim
