// Rows of the transport matrix: the vertices that the rays of a vertex hit.
#include "compressor/bake/transport_row.h"

#include <algorithm>

namespace paim {

void HitTracer::trace(const Vec3f& origin, const Vec3f& normal, const DirectionSampler& sampler,
                      uint64_t key) {
    sampler.generate(normal, key, rays_);
    num_points_ += sampler.num_points();
    hits_.resize(rays_.num_rays);
    scene_.intersect(origin, rays_.x.data(), rays_.y.data(), rays_.z.data(), rays_.num_rays,
                     hits_.data());
    for (size_t j = 0; j < hits_.size(); ++j) {
        const Hit& hit = hits_[j];
        if (hit.triangle == kNoTriangle) continue;
        const Triangle& t = topology_.triangles[hit.triangle];
        const Vec3d a = positions_[t[0]].cast<double>();
        const Vec3d out =
            (positions_[t[1]].cast<double>() - a).cross(positions_[t[2]].cast<double>() - a);
        if (out.dot(Vec3f(rays_.x[j], rays_.y[j], rays_.z[j]).cast<double>()) > 0.0) {
            ++num_back_hits_;
            continue;
        }
        const float weight = rays_.weights[j];
        shares_.push_back({t[0], weight * (1.0f - hit.u - hit.v)});
        shares_.push_back({t[1], weight * hit.u});
        shares_.push_back({t[2], weight * hit.v});
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
        row.push_back({vertex, static_cast<float>(sum / static_cast<double>(num_points_))});
    }
}

}  // namespace paim
