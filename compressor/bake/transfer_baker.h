// Diffuse shadowed transfer of one pose (E1).
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/bake/bounces.h"
#include "compressor/bake/direction_sampler.h"
#include "compressor/scene/still_mesh.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

// Raised whenever the same options give other bytes, so that results of different builds are not
// mixed.
constexpr uint32_t kBakerVersion = 5;

// Every vertex traces its rays in two halves with random numbers of their own (split_estimate.h).
// The mean of their estimates is the transfer. Half their difference is its noise: one draw with
// the variance of the error, up to O(1/N²), and uncorrelated with it. With a fixed count all rays
// of a vertex are traced at once. With a noise target they are traced in batches, each a third to a
// half as large as all before it, until the vertex is below the target by the noise of its
// neighbours (noise_target.h). Bounced light is added to the halves afterwards (bounces.h). The
// target is for light straight from the sky.
class TransferBaker {
  public:
    // albedo      of the meshes to bake; only used if light bounces
    // still_mesh  also blocks light and bounces it
    explicit TransferBaker(const BakeOptions& options, Albedo albedo = {},
                           StillMesh still_mesh = {});

    // Bakes the still mesh without the poses. If light bounces, it must be called before bake().
    BakedPose bake_still_mesh();

    // pose     positions [V] finite, normals [V] unit or zero (transfer 0)
    // p        the number of the pose, which keys the random numbers
    // Deterministic on any number of threads. Errors: those of RayScene.
    BakedPose bake(const Topology& topology, const Pose& pose, uint32_t p) const;

    // Three channels if light bounces off colours, otherwise one.
    TransferLayout layout() const { return bake_layout(options_, albedo_, still_mesh_); }

    static TransferLayout bake_layout(const BakeOptions& options, const Albedo& albedo,
                                      const StillMesh& still_mesh);

  private:
    class PoseBake;

    BakeOptions options_;
    Albedo albedo_;
    StillMesh still_mesh_;
    BounceTerms still_terms_;  // if light bounces
    // The rays of a half come in batches, one sampler each; one batch if the count is fixed.
    std::vector<std::unique_ptr<DirectionSampler>> batches_;
    sh::BatchBasis basis_;
};

}  // namespace paim
