// Rows of the transport matrix: the vertices that the rays of a vertex hit.
#include "compressor/bake/transport_row.h"

#include <algorithm>

namespace paim {

void HitTracer::trace(uint32_t vertex, const RayStart& start, const Vec3f& normal,
                      const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half,
                      double weight) {
    hits_.trace(vertex, start, normal, sampler, keys, half);
    num_points_ += weight * sampler.num_points();
    for (const SurfaceHit& hit : hits_.hits()) {
        const float ray_weight = static_cast<float>(weight) * hits_.rays().weights[hit.ray];
        for (uint32_t corner = 0; corner < hit.num_corners; ++corner) {
            shares_.push_back({hit.vertices[corner], ray_weight * hit.weights[corner]});
        }
    }
}

void HitTracer::end(TransportRow& row) {
    // Stable, so that sums have a fixed order.
    std::stable_sort(shares_.begin(), shares_.end(),
                     [](const HitWeight& a, const HitWeight& b) { return a.vertex < b.vertex; });
    row.clear();
    for (size_t j = 0; j < shares_.size();) {
        const uint32_t vertex = shares_[j].vertex;
        double sum = 0.0;
        for (; j < shares_.size() && shares_[j].vertex == vertex; ++j) {
            sum += static_cast<double>(shares_[j].weight);
        }
        row.push_back({vertex, static_cast<float>(sum / num_points_)});
    }
}

}  // namespace paim
