// Shadowed transfer of one pose: diffuse (E1) and, where materials are glossy, glossy.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/bake/direction_sampler.h"
#include "compressor/bake/gloss_reflections.h"
#include "compressor/bake/pose_bounces.h"
#include "compressor/scene/still_mesh.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

// Raised whenever the same options give other bytes, so that results of different builds are not
// mixed. Bakes of a sampler whose directions alone change, and bakes with gloss, have versions of their
// own.
constexpr uint32_t baker_version(SamplerKind sampler, bool has_gloss) {
    if (has_gloss) return 8;
    return sampler == SamplerKind::uniform_sobol ? 7 : 6;
}

// Every vertex traces its rays in two halves, which are one set of directions (split_estimate.h,
// cosine_directions.h). The mean of their estimates is the transfer. Half their difference, scaled
// (DirectionSampler::noise_scale), is its noise: one draw with the variance of the error, and
// uncorrelated with it. With a fixed count all rays of a vertex are traced at once. With a noise
// target they are traced in rounds: a first one of 64 rays, then as many as the noise of the
// neighbours asks for (noise_target.h). Bounced light is added to the halves afterwards
// (bounces.h). The target is for light straight from the sky, and for diffuse transfer. Glossy
// transfer comes from the same rays (gloss_pass.h).
class TransferBaker {
  public:
    // albedo      of the meshes to bake; only used if light bounces
    // still_mesh  also blocks light and bounces it
    // materials   of the meshes to bake
    // Errors: those of parse_brdf() for a glossy material.
    explicit TransferBaker(const BakeOptions& options, Albedo albedo = {},
                           StillMesh still_mesh = {}, Materials materials = {});

    // Bakes the still mesh without the poses. If light bounces, it must be called before bake().
    BakedPose bake_still_mesh();

    // pose     positions [V] finite, normals [V] unit or zero (transfer 0)
    // p        the number of the pose, which keys the random numbers
    // Deterministic on any number of threads. Errors: those of RayScene.
    BakedPose bake(const Topology& topology, const Pose& pose, uint32_t p) const;

    // Three channels if light bounces off colours, tints among them, otherwise one.
    TransferLayout layout() const {
        return bake_layout(options_, albedo_, still_mesh_, materials_);
    }
    // Of the glossy transfer of poses and still mesh, in the axes of the pose, if any material of either
    // is glossy.
    const std::optional<TransferLayout>& gloss_layout() const { return gloss_layout_; }

    static TransferLayout bake_layout(const BakeOptions& options, const Albedo& albedo,
                                      const StillMesh& still_mesh, const Materials& materials = {});
    // Errors: those of parse_brdf().
    static std::optional<TransferLayout> gloss_layout(const BakeOptions& options,
                                                      const Albedo& albedo,
                                                      const StillMesh& still_mesh,
                                                      const Materials& materials);

  private:
    class PoseBake;

    // Sets of directions of different sizes, made when they are needed for the first time. Safe to
    // use from several threads.
    class Samplers {
      public:
        explicit Samplers(const BakeOptions& options);

        // With this many points of a half.
        const DirectionSampler& of(uint32_t num_points) const;
        // That of the first round of every vertex.
        const DirectionSampler& first() const { return of(first_points_); }

      private:
        SamplerKind kind_;
        HalfRelation relation_;
        uint32_t first_points_;
        mutable std::mutex mutex_;
        mutable std::map<uint32_t, std::unique_ptr<DirectionSampler>> by_size_;
    };

    BakeOptions options_;
    Albedo albedo_;
    StillMesh still_mesh_;
    Materials materials_;
    std::optional<TransferLayout> gloss_layout_;
    GlossReflections reflections_;
    StillTerms still_terms_;  // if light bounces
    Samplers samplers_;
    sh::BatchBasis basis_;
    sh::BatchBasis gloss_basis_;  // of the light of glossy transfer
};

}  // namespace paim
