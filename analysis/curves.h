// Error curves: error, bytes and time for numbers of components and bands.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/picture_errors.h"
#include "analysis/stable_time.h"
#include "paim/codec/asset.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/image/image.h"
#include "paim/metrics/array_error.h"
#include "paim/metrics/shape_error.h"

namespace paim {

// One setting of a curve: first what is known before measuring, then what measure.h measures.
struct CurvePoint {
    uint32_t value = 0;  // components or bands kept
    bool all = false;    // whether these are all
    DecodeLimits limits;
    double theory_error = 0.0;  // E5
    double energy_error = 0.0;
    uint64_t size_bytes = 0;  // of the .paim with this setting, and everything else

    std::vector<PictureErrors> seen;  // [lights] against the reference
    DistanceError distance;           // of positions to the bake's
    ShapeError shape;                 // of the measured poses; without what belongs to time
    ArrayError transfer;              // to the bake's transfer; dropped values count as zero
    PoseTime decode;                  // to rebuild one pose on the CPU
    std::vector<Image> images;        // [lights] of the first measured pose in the first view
};

struct Curve {
    std::string name;                // "geometry_components", "transfer_components", "bands"
    std::string title;               // for reports
    std::vector<CurvePoint> points;  // in descending order, all components or bands first
    // [0 … all] Theoretical error of every setting.
    std::vector<double> theory_errors;
    std::vector<double> energy_errors;
};

// [bands²] Norm of each coefficient over vertices, channels and poses. These norms take the place
// of singular values when bands are dropped (docs/metrics.md).
std::vector<double> coefficient_norms(const BakeReader& bake);

// The three curves of the paper, not measured yet. Each has a point for all components (bands),
// then one for each wanted number that is smaller. The asset has all components as f32.
std::vector<Curve> plan_curves(const BakeReader& bake, const Asset& asset,
                               const std::vector<uint32_t>& components,
                               const std::vector<uint32_t>& bands);

size_t num_points(const std::vector<Curve>& curves);

}  // namespace paim
