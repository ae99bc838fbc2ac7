// Diffuse shadowed transfer of one pose (E1).
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic,
//           Low-Frequency Lighting Environments, 2002
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/bake/direction_sampler.h"
#include "compressor/scene/static_mesh.h"
#include "paim/format/bake_directory.h"
#include "paim/mesh/pose_source.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

// Raised whenever the same options give other bytes, so that bakes of different builds do not mix.
constexpr uint32_t kBakerVersion = 2;

// Every vertex shoots two independent halves of its rays (half_sums.h). Their mean is the transfer,
// half their difference its noise. With a fixed count all rays of a vertex are shot at once; with an
// error target they are shot in batches, each as many as all before, until the vertex's own noise and
// the mean over its neighbours are below the target.
class TransferBaker {
  public:
    explicit TransferBaker(const BakeOptions& options);

    // pose     positions [V] finite, normals [V] unit or zero (transfer 0)
    // p        the pose's number, which keys the random streams
    // Deterministic on any number of threads. Errors: those of Scene.
    // scenery  blocks light too
    BakedPose bake(const Topology& topology, const Pose& pose, uint32_t p,
                   const StaticMesh& scenery = {}) const;

    TransferLayout layout() const { return {TransferKind::diffuse, options_.bands, 1}; }

  private:
    class PoseBake;

    BakeOptions options_;
    // The rays of a half come in batches, one sampler each; one batch if the count is fixed.
    std::vector<std::unique_ptr<DirectionSampler>> batches_;
    sh::BatchBasis basis_;
};

}  // namespace paim
