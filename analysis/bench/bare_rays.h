// The least that tracing shadow rays can cost: rtcOccluded1 in a loop, with nothing round it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::bench {

// Rays that a bake traces, made beforehand: `per_origin` directions for each origin, in the bake's
// order.
struct RayList {
    std::vector<Vec3f> origins;
    std::vector<Vec3f> directions;  // [origins][per_origin]
    uint32_t per_origin = 0;
};

// The same acceleration structure as paim::RayScene: same flags, same build quality.
class BareScene {
  public:
    BareScene(const Topology& topology, std::span<const Vec3f> positions);
    ~BareScene();

    // One ray, by rtcOccluded1.
    bool is_blocked(const Vec3f& origin, const Vec3f& direction) const;

    // Traces all rays on as many threads, in pieces of `origins_per_piece`. returns how many are
    // occluded
    uint64_t count_blocked(const RayList& rays, size_t origins_per_piece) const;

    // The same by rtcOccluded16; rays.per_origin is a multiple of 16.
    uint64_t count_blocked_by_packets(const RayList& rays, size_t origins_per_piece) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace paim::bench
