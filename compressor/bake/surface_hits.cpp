// Where the rays of a vertex meet the fronts of surfaces.
#include "compressor/bake/surface_hits.h"

namespace paim {

void SurfaceHits::trace(uint32_t vertex, const RayStart& start, const Vec3f& normal,
                        const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half) {
    sampler.generate(normal, keys, half, rays_);
    find_hits(start);
    on_surface_.clear();
    for (uint32_t j = 0; j < rays_.num_rays; ++j) {
        if (start.fan != nullptr && start.fan->hides(direction(j))) {
            on_surface_.push_back({j, 1, {vertex, 0, 0}, {1.0f, 0.0f, 0.0f}});
        } else if (hits_[j].triangle != kNoTriangle) {
            add_hit(hits_[j], j);
        }
    }
}

Vec3d SurfaceHits::direction(size_t ray) const {
    return Vec3f(rays_.x[ray], rays_.y[ray], rays_.z[ray]).cast<double>();
}

void SurfaceHits::find_hits(const RayStart& start) {
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

void SurfaceHits::add_hit(const Hit& hit, uint32_t ray) {
    const Triangle& t = topology_.triangles[hit.triangle];
    const Vec3d a = positions_[t[0]].cast<double>();
    const Vec3d out =
        (positions_[t[1]].cast<double>() - a).cross(positions_[t[2]].cast<double>() - a);
    if (out.dot(direction(ray)) > 0.0) {
        ++num_back_hits_;
        return;
    }
    on_surface_.push_back({ray, 3, t, {1.0f - hit.u - hit.v, hit.u, hit.v}});
}

}  // namespace paim
