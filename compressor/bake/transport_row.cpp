// Rows of the transport matrix: the vertices that the rays of a vertex hit.
#include "compressor/bake/transport_row.h"

#include <algorithm>

namespace paim {

void HitTracer::trace(uint32_t vertex, const RayStart& start, const Vec3f& normal,
                      const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half,
                      double weight) {
    sampler.generate(normal, keys, half, rays_);
    num_points_ += weight * sampler.num_points();
    find_hits(start);
    for (size_t j = 0; j < hits_.size(); ++j) {
        const float ray_weight = static_cast<float>(weight) * rays_.weights[j];
        if (start.fan != nullptr && start.fan->hides(direction(j))) {
            shares_.push_back({vertex, ray_weight});
        } else if (hits_[j].triangle != kNoTriangle) {
            add_hit(hits_[j], j, ray_weight);
        }
    }
}

Vec3d HitTracer::direction(size_t ray) const {
    return Vec3f(rays_.x[ray], rays_.y[ray], rays_.z[ray]).cast<double>();
}

void HitTracer::find_hits(const RayStart& start) {
    hits_.resize(rays_.num_rays);
    if (start.fan == nullptr) {
        scene_.intersect(start.origin, rays_.x.data(), rays_.y.data(), rays_.z.data(),
                         rays_.num_rays, hits_.data());
        return;
    }
    for (size_t j = 0; j < hits_.size(); ++j) {
        hits_[j] =
            scene_.intersect_first(start.origin, direction(j).cast<float>(), start.fan->triangles())
                .value_or(Hit{0.0f, kNoTriangle, 0.0f, 0.0f});
    }
}

void HitTracer::add_hit(const Hit& hit, size_t ray, float weight) {
    const Triangle& t = topology_.triangles[hit.triangle];
    const Vec3d a = positions_[t[0]].cast<double>();
    const Vec3d out =
        (positions_[t[1]].cast<double>() - a).cross(positions_[t[2]].cast<double>() - a);
    if (out.dot(direction(ray)) > 0.0) {
        ++num_back_hits_;
        return;
    }
    shares_.push_back({t[0], weight * (1.0f - hit.u - hit.v)});
    shares_.push_back({t[1], weight * hit.u});
    shares_.push_back({t[2], weight * hit.v});
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
