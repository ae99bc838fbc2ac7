// A data matrix of an animation, stored as a mean and weighted components.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "paim/base/export.h"
#include "paim/codec/stored_values.h"

namespace paim {

// The most exceptions of a pose (LowRank::num_usual_components()).
constexpr uint32_t kExceptionsPerPose = 2;

// The largest step of integers: 2^15 times it is finite. Larger ones are neither written nor read.
constexpr float kMaxStep = std::numeric_limits<float>::max() / 32768.0f;

// Column p of the matrix is pose p (E3, E4):
//   mean + Σ_k weights[k][p] · components[k].
// Rows are plane-major: row = plane · N + n. A point n is a vertex, or another row that the codec
// rebuilds vertices from.
//
// Floats: components have unit RMS (|component_k|² = rows) before noise is taken out of them, so
// that half floats are precise enough, and weights contain the singular value. Integers: values are
// multiples of their plane's step, and weights have about unit RMS, so that one step costs about
// the same error in every component.
struct PAIM_EXPORT LowRank {
    uint32_t num_points = 0;
    uint32_t num_planes = 0;
    uint32_t num_poses = 0;
    uint32_t num_components = 0;
    Precision precision = Precision::f32;  // widest type in the section; a plane may be narrower
    std::vector<float> steps;              // [planes] of integers; floats: empty, all 1
    StoredValues mean;                     // [planes][N], in steps
    std::vector<StoredValues> components;  // [K] of [planes][N], in steps
    std::vector<float> weights;            // [K][P]
    // [K] The weights of component k are integer multiples of this. Empty: weights are arbitrary
    // floats.
    std::vector<float> weight_steps;
    // Integers that are smoothed when they are read (surface_smoothing.h) are multiples of
    // 2^-fraction_bits of those in the file, and so are steps. 0: they are as in the file.
    uint32_t fraction_bits = 0;
    std::vector<uint32_t> smoothing;      // [1 + K][planes] rounds, of the mean and each component
    std::vector<double> singular_values;  // [rank of the full matrix], descending, unshrunk
    // [K] Index of the singular value of each component, ascending. Empty: component k has the
    // k-th. An index is missing where quantisation rounded a whole component to zero.
    std::vector<uint32_t> singular_indices;

    uint32_t singular_index(uint32_t k) const {
        return singular_indices.empty() ? k : singular_indices[k];
    }
    // The components before the exceptions. An exception is a component that is zero but for
    // vertices that are outliers in one pose, with weights that are zero but in this pose. Its
    // singular value is 0, so that exceptions come last.
    uint32_t num_usual_components() const;
    size_t num_rows() const { return size_t{num_planes} * num_points; }
    float step(uint32_t plane) const { return steps.empty() ? 1.0f : steps[plane]; }
    bool holds_floats() const { return mean.holds_floats(); }

    // The matrix of a still part: a mean without components, in one pose.
    // values  [planes][N], in steps
    // steps   [planes], of integers; empty for floats
    static LowRank still(uint32_t num_planes, StoredValues values, std::vector<float> steps = {});

    // The first num_planes · num_points values of the mean, steps applied. [planes][N]
    std::vector<float> mean_floats() const;

    // Drops all components from number `count` on.
    void keep_components(uint32_t count);

    bool operator==(const LowRank&) const = default;
};

}  // namespace paim
