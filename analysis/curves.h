// Error curves: what components and bands cost in accuracy and save in bytes and time.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry, 2012
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/reference.h"

namespace paim {

// One setting of one table.
struct CurvePoint {
    uint32_t value = 0;         // components or bands kept
    bool all = false;           // whether that is all there are
    double theory_error = 0.0;  // E5
    double energy_error = 0.0;
    std::vector<double> visual_error;  // [lights] E6 over all measured poses
    uint64_t size_bytes = 0;           // of the .paim with this setting, all else kept
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

// Norm of each coefficient over vertices, channels and poses, [bands²]: what plays the part of singular
// values where bands are dropped (docs/metrics.md).
std::vector<double> coefficient_norms(const BakeReader& bake);

// The three curves of the paper. The model holds all components in f32.
// on_point  called after each point
std::vector<Curve> measure_curves(const BakeReader& bake, const Model& model, const Stage& stage,
                                  const std::vector<uint32_t>& components,
                                  const std::vector<uint32_t>& bands,
                                  const std::function<void()>& on_point);

// How many points that measures.
size_t num_curve_points(const Model& model, const std::vector<uint32_t>& components,
                        const std::vector<uint32_t>& bands);

}  // namespace paim
