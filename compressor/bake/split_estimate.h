// Estimates of the transfer of a vertex from each half of its rays.
// Based on: Owen, Monte Carlo Theory, Methods and Examples, 2013, chapter 8.9 (control variates)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/direction_sampler.h"
#include "compressor/bake/ray_start.h"
#include "paim/sh/basis.h"
#include "paim/trace/ray_scene.h"

namespace paim {

// Running sums over the rays of one half. Rays of one round (transfer_baker.h) have the same weight.
struct SplitEstimate {
    explicit SplitEstimate(size_t num_coefficients)
        : all(num_coefficients), open(num_coefficients) {}

    std::vector<double> all;    // [C] Σ weight · y_i
    std::vector<double> open;   // [C] the same sum over rays that are not occluded
    double num_points = 0.0;    // of the sampler, Σ weight
    uint64_t num_rays = 0;      // of these, above the horizon and traced
    uint64_t num_occluded = 0;  // of these
};

// Traces the rays of one half and adds them up. Each thread needs its own for each half.
class SplitTracer {
  public:
    explicit SplitTracer(const sh::BatchBasis& basis);

    // Traces and counts rays. The sums do not change before add().
    void trace(const RayScene& scene, const RayStart& start, const Vec3f& normal,
               const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half,
               SplitEstimate& sums);

    // Makes rays of which is known that all are occluded or none is, to be added to the sums.
    void assume(const Vec3f& normal, const DirectionSampler& sampler, const HalfKeys& keys,
                uint32_t half, bool occluded);

    // Adds the rays that were traced or made last to the sums.
    void add(double weight, SplitEstimate& sums);

  private:
    // Adds the rays of some packets to each of the sums.
    void accumulate(std::span<const size_t> packets, std::span<const float> weights, double weight,
                    std::span<std::vector<double>* const> sums);

    const sh::BatchBasis& basis_;
    RaySet rays_;
    uint32_t num_points_ = 0;
    std::vector<float> occluded_;      // [rays] 1 or 0
    std::vector<float> open_weights_;  // [padded rays]
    std::vector<float> lanes_;         // [C][kSumLanes]
    // The first rays of packets of sixteen whose rays are all open, all occluded, or neither. Those
    // of the first have the same sum of all rays and of open ones, which needs the basis once.
    std::vector<size_t> open_packets_, occluded_packets_, mixed_packets_;
};

// Each half's estimate of the transfer is
//
//     t_i = c · lobe_i + (open_i − c · all_i) / points,
//
// unbiased for any c that does not come from the rays of the vertex. The nearer c is to the fraction
// of its rays that are open, the less noise the unoccluded part adds, whose integral is known. If
// all rays are open and c = 1, the estimate is the closed form, and if all are occluded and c = 0,
// it is zero. Both are exact.
// sums         of a half that has points
// unoccluded   [C] the transfer if nothing is occluded; empty: c = 0
// estimate     [C]
void estimate_half(const SplitEstimate& sums, std::span<const double> unoccluded, double c,
                   std::span<double> estimate);

}  // namespace paim
