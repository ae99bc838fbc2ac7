// Components become integers, all with one step.
// Based on: Cover and Thomas, Elements of Information Theory, 2006, section 10.3.3 (reverse
//           water-filling); Sullivan, Efficient Scalar Quantization of Exponential and Laplacian
//           Random Variables, 1996 (dead zones)
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/encode/quantise/scaled_factors.h"
#include "paim/codec/asset.h"

namespace paim {

struct Quantiser {
    double step = 1.0;                 // of a value whose plane weighs 1
    uint32_t num_components = 0;       // of the factors that are kept, at most
    std::vector<double> plane_weight;  // [planes] of squared errors, above 0

    bool operator==(const Quantiser&) const = default;
};

// Components scaled to weights of unit RMS all have the step ‖plane weight‖^-½ · step: errors then
// cost the same everywhere, and components weaker than the step vanish by themselves. Values nearer
// to zero than 0.6 steps become zero (others round to nearest), since a zero is cheap and its error
// small. Afterwards weights are fitted to the integers by least squares and quantised so that
// one of their steps costs as much error as one of a component's. Components whose values or
// weights are nothing but zero are dropped, the others say which singular value they have.
// Error (unsupported) if a step is so small that values do not fit in 16 bits.
LowRank quantise(const ScaledFactors& factors, const Quantiser& quantiser);

// Weighted squared error of such a matrix over all rows and poses, without the rounding of weights.
double quantised_error(const ScaledFactors& factors, const Quantiser& quantiser);

// The same if weights were not fitted: a little more, and much sooner known.
double rounding_error(const ScaledFactors& factors, const Quantiser& quantiser);

// Memory of the least squares of K components in quantise() and quantised_error(): the normal
// equations of each plane and of all, and on each thread the points at work.
uint64_t least_squares_bytes(uint64_t num_planes, uint64_t num_components, uint64_t num_threads);

// The largest step with which the error is at most `most` (largest_step.h); 0 if there is none down
// to 2⁻¹⁵ of the largest value. quantiser.step is ignored.
double largest_step(const ScaledFactors& factors, Quantiser quantiser, double most);

// The smallest step with which every value fits, mean included.
double smallest_step(const ScaledFactors& factors, const Quantiser& quantiser, Precision precision);

}  // namespace paim
