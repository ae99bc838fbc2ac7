// Estimates of the transfer of a vertex from each half of its rays.
// Based on: Owen 2013 (see the header)
#include "compressor/bake/split_estimate.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr size_t kBatch = sh::BatchBasis::kBatch;
constexpr size_t kSumLanes = sh::BatchBasis::kSumLanes;
// Lane sums are floats. After this many packets of rays they are added to doubles, before rounding
// matters.
constexpr size_t kPacketsPerFlush = 32;

}  // namespace

SplitTracer::SplitTracer(const sh::BatchBasis& basis)
    : basis_(basis), lanes_(static_cast<size_t>(basis.bands() * basis.bands()) * kSumLanes) {}

void SplitTracer::trace(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                        const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half,
                        SplitEstimate& sums) {
    sampler.generate(normal, keys, half, rays_);
    num_points_ = sampler.num_points();
    occluded_.resize(rays_.num_rays);
    sums.num_occluded += occluded_from(scene, start, rays_.x.data(), rays_.y.data(), rays_.z.data(),
                                       rays_.num_rays, occluded_.data());
    sums.num_rays += rays_.num_rays;
}

void SplitTracer::assume(const Vec3f& normal, const DirectionSampler& sampler, const HalfKeys& keys,
                         uint32_t half, bool occluded) {
    sampler.generate(normal, keys, half, rays_);
    num_points_ = sampler.num_points();
    occluded_.assign(rays_.num_rays, occluded ? 1.0f : 0.0f);
}

void SplitTracer::add(double weight, SplitEstimate& sums) {
    for (auto* packets : {&open_packets_, &mixed_packets_, &occluded_packets_}) packets->clear();
    open_weights_ = rays_.weights;  // the weight of padding is zero
    for (size_t first = 0; first < rays_.weights.size(); first += kBatch) {
        const size_t end = std::min<size_t>(first + kBatch, rays_.num_rays);
        float num_occluded = 0.0f;
        for (size_t j = first; j < end; ++j) {
            num_occluded += occluded_[j];
            open_weights_[j] *= 1.0f - occluded_[j];
        }
        auto& packets = num_occluded == 0.0f                              ? open_packets_
                        : num_occluded == static_cast<float>(end - first) ? occluded_packets_
                                                                          : mixed_packets_;
        packets.push_back(first);
    }
    std::vector<double>* const both[] = {&sums.all, &sums.open};
    accumulate(open_packets_, rays_.weights, weight, both);
    accumulate(occluded_packets_, rays_.weights, weight, std::span(both).first(1));
    accumulate(mixed_packets_, rays_.weights, weight, std::span(both).first(1));
    accumulate(mixed_packets_, open_weights_, weight, std::span(both).last(1));
    sums.num_points += weight * num_points_;
}

void SplitTracer::accumulate(std::span<const size_t> packets, std::span<const float> weights,
                             double weight, std::span<std::vector<double>* const> sums) {
    for (size_t begin = 0; begin < packets.size(); begin += kPacketsPerFlush) {
        std::fill(lanes_.begin(), lanes_.end(), 0.0f);
        for (const size_t first :
             packets.subspan(begin, std::min(kPacketsPerFlush, packets.size() - begin))) {
            basis_.accumulate(rays_.x.data() + first, rays_.y.data() + first,
                              rays_.z.data() + first, weights.data() + first, lanes_.data());
        }
        for (std::vector<double>* to : sums) {
            for (size_t i = 0; i < to->size(); ++i) {
                for (size_t lane = 0; lane < kSumLanes; ++lane) {
                    (*to)[i] += weight * static_cast<double>(lanes_[i * kSumLanes + lane]);
                }
            }
        }
    }
}

void estimate_half(const SplitEstimate& sums, std::span<const double> unoccluded, double c,
                   std::span<double> estimate) {
    PAIM_CHECK_EQ(estimate.size(), sums.all.size());
    PAIM_CHECK(sums.num_points > 0.0);
    if (unoccluded.empty()) c = 0.0;
    for (size_t i = 0; i < estimate.size(); ++i) {
        const double lobe = unoccluded.empty() ? 0.0 : unoccluded[i];
        estimate[i] = c * lobe + (sums.open[i] - c * sums.all[i]) / sums.num_points;
    }
}

}  // namespace paim
