// The glossy transfer of a pose, from the rays that its diffuse transfer is made of.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compressor/bake/gloss_reflections.h"
#include "compressor/bake/pose_rays.h"
#include "paim/sh/basis.h"

namespace paim {

// Which vertices have glossy transfer, and their reflections.
struct GlossRows {
    // reflections  of all materials of the mesh; kept by reference
    GlossRows(const Topology& topology, const Materials& materials,
              const GlossReflections& reflections);

    std::vector<uint32_t> vertices;                   // [R] mesh/materials.h: glossy_rows()
    std::vector<const GlossReflection*> reflections;  // [R] nullptr: matte, of a glossy face
    std::vector<Vec3f> tints;                         // [R]
};

// Traces the rays of all rounds again and estimates the transfer of both halves, [O · C][R] of one
// channel. The factor c of an unoccluded vertex is that of the diffuse estimate, so that vertices that
// are all open or all occluded are exact alike (split_estimate.h). Deterministic on any number of
// threads.
// basis  of as many bands as the layout has of light
std::array<std::vector<float>, 2> estimate_gloss(const PoseRays& rays, const GlossRows& rows,
                                                 const TransferLayout& layout,
                                                 const sh::BatchBasis& basis);

}  // namespace paim
