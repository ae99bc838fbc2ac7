// Embree 3 or 4, whichever the system has, behind one set of names.
#pragma once

#if PAIM_EMBREE_VERSION >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace paim::embree {

// The default way to trace a ray, or sixteen of which `valid` takes part (-1) or not (0). May be
// shared by the rays of one thread.
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
