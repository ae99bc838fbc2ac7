// Diffuse shadowed transfer of one pose (E1).
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic,
//           Low-Frequency Lighting Environments, 2002
#pragma once

#include <cstdint>

#include "compressor/bake/cosine_directions.h"
#include "paim/format/bake_directory.h"
#include "paim/mesh/pose_source.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

// Raised whenever the same options give other bytes, so that bakes of different builds do not mix.
constexpr uint32_t kBakerVersion = 1;

struct BakeOptions {
    uint32_t bands = 5;   // 1 … sh::kMaxBands
    uint32_t rays = 512;  // per vertex, even, 2 … 2^24
    uint64_t seed = 1;
};

// Each vertex shoots two independent halves of its rays. A half's estimate is
//
//     t_i = c â_l y_i(n) + mean over its rays of ((1 − blocked) − c) y_i,
//
// unbiased for any c that does not come from those rays. c is the fraction of open rays in the *other*
// half: open vertices (c = 1) get the closed form exactly, closed ones (c = 0) exactly zero, and in
// between the unoccluded part, whose integral is known, carries no noise of its own. The mean of the
// halves is the transfer, half their difference estimates its error.
class TransferBaker {
  public:
    explicit TransferBaker(const BakeOptions& options);

    // pose     positions [V] finite, normals [V] unit or zero (transfer 0)
    // p        the pose's number, which keys the random streams
    // Deterministic on any number of threads. Errors: those of Scene.
    BakedPose bake(const Topology& topology, const Pose& pose, uint32_t p) const;

    TransferLayout layout() const { return {TransferKind::diffuse, options_.bands, 1}; }

  private:
    struct Workspace;
    struct Estimate;
    Estimate estimate(const class Scene& scene, const Vec3f& origin, const Vec3f& normal,
                      uint32_t p, uint32_t v, Workspace& work) const;

    BakeOptions options_;
    CosineDirections directions_;
    sh::BatchBasis basis_;
};

}  // namespace paim
