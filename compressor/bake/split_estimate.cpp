// Estimates of the transfer of a vertex from each half of its rays.
// Based on: Owen 2013 (see the header)
#include "compressor/bake/split_estimate.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr size_t kBatch = sh::BatchBasis::kBatch;
constexpr size_t kSumLanes = sh::BatchBasis::kSumLanes;
// Lane sums are floats. After this many rays they are added to doubles, before rounding matters.
constexpr size_t kRaysPerFlush = 32 * kBatch;

}  // namespace

SplitTracer::SplitTracer(const sh::BatchBasis& basis)
    : basis_(basis), lanes_(static_cast<size_t>(basis.bands() * basis.bands()) * kSumLanes) {}

void SplitTracer::trace(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                        const DirectionSampler& sampler, uint64_t key, SplitEstimate& sums) {
    sampler.generate(normal, key, rays_);
    occluded_.resize(rays_.num_rays);
    sums.num_occluded += occluded_from(scene, start, rays_.x.data(), rays_.y.data(), rays_.z.data(),
                                       rays_.num_rays, occluded_.data());
    sums.num_points += sampler.num_points();
    sums.num_rays += rays_.num_rays;
}

void SplitTracer::add(SplitEstimate& sums) {
    open_weights_ = rays_.weights;  // the weight of padding is zero
    for (size_t j = 0; j < rays_.num_rays; ++j) open_weights_[j] *= 1.0f - occluded_[j];
    accumulate(rays_.weights, sums.all);
    accumulate(open_weights_, sums.open);
}

void SplitTracer::accumulate(std::span<const float> weights, std::vector<double>& sums) {
    for (size_t first = 0; first < weights.size(); first += kRaysPerFlush) {
        std::fill(lanes_.begin(), lanes_.end(), 0.0f);
        const size_t end = std::min(weights.size(), first + kRaysPerFlush);
        for (size_t j = first; j < end; j += kBatch) {
            basis_.accumulate(rays_.x.data() + j, rays_.y.data() + j, rays_.z.data() + j,
                              weights.data() + j, lanes_.data());
        }
        for (size_t i = 0; i < sums.size(); ++i) {
            for (size_t lane = 0; lane < kSumLanes; ++lane) {
                sums[i] += static_cast<double>(lanes_[i * kSumLanes + lane]);
            }
        }
    }
}

void estimate_split(std::span<const SplitEstimate, 2> halves, std::span<const double> unoccluded,
                    std::span<double> estimates) {
    const size_t num_coefficients = halves[0].all.size();
    PAIM_CHECK_EQ(estimates.size(), 2 * num_coefficients);
    const uint64_t num_rays = halves[0].num_rays + halves[1].num_rays;
    const uint64_t num_occluded = halves[0].num_occluded + halves[1].num_occluded;
    if (!unoccluded.empty() && num_occluded == 0) {
        for (const size_t h : {size_t{0}, size_t{1}}) {
            std::copy(unoccluded.begin(), unoccluded.end(),
                      estimates.begin() + static_cast<std::ptrdiff_t>(h * num_coefficients));
        }
        return;
    }
    if (num_occluded == num_rays) {
        std::fill(estimates.begin(), estimates.end(), 0.0);
        return;
    }
    for (size_t h = 0; h < 2; ++h) {
        const SplitEstimate& half = halves[h];
        const SplitEstimate& other = halves[1 - h];
        const double c = unoccluded.empty() ? 0.0
                                            : 1.0 - static_cast<double>(other.num_occluded) /
                                                        static_cast<double>(other.num_rays);
        for (size_t i = 0; i < num_coefficients; ++i) {
            const double lobe = unoccluded.empty() ? 0.0 : unoccluded[i];
            estimates[h * num_coefficients + i] =
                c * lobe + (half.open[i] - c * half.all[i]) / static_cast<double>(half.num_points);
        }
    }
}

}  // namespace paim
