// Estimates of the transfer of a vertex from each half of its rays, and their noise from both.
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

// Running sums over the rays of one half.
struct SplitEstimate {
    explicit SplitEstimate(size_t num_coefficients)
        : all(num_coefficients), open(num_coefficients) {}

    std::vector<double> all;    // [C] Σ weight · y_i
    std::vector<double> open;   // [C] the same sum over rays that are not occluded
    uint64_t num_points = 0;    // of the sampler
    uint64_t num_rays = 0;      // of these, above the horizon and traced
    uint64_t num_occluded = 0;  // of these
};

// Traces the rays of one half and adds them up. Each thread needs its own for each half.
class SplitTracer {
  public:
    explicit SplitTracer(const sh::BatchBasis& basis);

    // Traces and counts rays. The sums do not change before add().
    void trace(const RayScene& scene, const RayStart& start, const Vec3f& normal,
               const DirectionSampler& sampler, uint64_t key, SplitEstimate& sums);

    // Adds the rays that were traced last to the sums.
    void add(SplitEstimate& sums);

  private:
    void accumulate(std::span<const float> weights, std::vector<double>& sums);

    const sh::BatchBasis& basis_;
    RaySet rays_;
    std::vector<float> occluded_;      // [rays] 1 or 0
    std::vector<float> open_weights_;  // [padded rays]
    std::vector<float> lanes_;         // [C][kSumLanes]
};

// Each half's estimate of the transfer is
//
//     t_i = c · lobe_i + (open_i − c · all_i) / points,
//
// unbiased for any c that does not come from those rays. c is the fraction of open rays in the
// *other* half: open vertices (c = 1) get the closed form exactly, closed ones (c = 0) exactly
// zero, and in between the unoccluded part, whose integral is known, carries no noise of its own.
// Half the difference of the two estimates has mean 0, is uncorrelated with the error of their
// mean, and has its variance, up to the covariance of the estimates: c of one half multiplies the
// rays of the other, so that this is Cov(c, all_i / points)² >= 0, of second order in 1 / points.
// The noise that is stated is too low by that (docs/algorithms/transfer.md).
// halves       both; their sums need not have been added up if all rays are open or all are
//              occluded
// unoccluded   [C] the transfer if nothing is occluded; empty: c = 0
// estimates    [2][C]
void estimate_split(std::span<const SplitEstimate, 2> halves, std::span<const double> unoccluded,
                    std::span<double> estimates);

}  // namespace paim
