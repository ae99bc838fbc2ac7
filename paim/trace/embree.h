// The same names for Embree 3 and 4, whichever the system has.
#pragma once

#if PAIM_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <limits>

#include "paim/base/vector.h"

namespace paim::embree {

// A ray without end, of any mask.
inline RTCRay make_ray(const Vec3f& origin, const Vec3f& direction) {
    RTCRay ray;
    ray.org_x = origin.x();
    ray.org_y = origin.y();
    ray.org_z = origin.z();
    ray.dir_x = direction.x();
    ray.dir_y = direction.y();
    ray.dir_z = direction.z();
    ray.tnear = 0.0f;
    ray.tfar = std::numeric_limits<float>::infinity();
    ray.time = 0.0f;
    ray.mask = 0xffffffffu;
    ray.id = 0;
    ray.flags = 0;
    return ray;
}

// Traces a ray, or sixteen, with default settings. `valid` says which of sixteen are traced (-1) or
// not (0). All rays of one thread may share a context.
class Context {
  public:
#if PAIM_EMBREE_VERSION >= 4
    Context() {
        rtcInitOccludedArguments(&occluded_);
        rtcInitIntersectArguments(&intersect_);
    }
    void occluded(RTCScene scene, RTCRay& ray) {
        rtcOccluded1(scene, &ray, &occluded_);
    }
    void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
        rtcOccluded16(valid, scene, &rays, &occluded_);
    }
    void intersect(RTCScene scene, RTCRayHit& ray) {
        rtcIntersect1(scene, &ray, &intersect_);
    }
    void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) {
        rtcIntersect16(valid, scene, &rays, &intersect_);
    }

  private:
    RTCOccludedArguments occluded_;
    RTCIntersectArguments intersect_;
#else
    Context() {
        rtcInitIntersectContext(&context_);
    }
    void occluded(RTCScene scene, RTCRay& ray) {
        rtcOccluded1(scene, &context_, &ray);
    }
    void occluded(const int* valid, RTCScene scene, RTCRay16& rays) {
        rtcOccluded16(valid, scene, &context_, &rays);
    }
    void intersect(RTCScene scene, RTCRayHit& ray) {
        rtcIntersect1(scene, &context_, &ray);
    }
    void intersect(const int* valid, RTCScene scene, RTCRayHit16& rays) {
        rtcIntersect16(valid, scene, &context_, &rays);
    }

  private:
    RTCIntersectContext context_;
#endif
};

}  // namespace paim::embree
