// Bounces of light in one pose, among vertices that are all matte (bounces.h) or not
// (glossy_bounces.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compressor/bake/glossy_bounces.h"
#include "compressor/scene/still_mesh.h"

namespace paim {

// The light of a still mesh, bounce by bounce. One of the two is empty.
struct StillTerms {
    BounceTerms diffuse;
    std::vector<GlossyTerm> glossy;
};

struct PoseBounces {
    const PoseRays& rays;
    const Albedo& albedo;
    const GlossRows& rows;
    const StillMesh& still_mesh;    // may be empty
    const GlossRows& still_rows;    // of the still mesh
    const StillTerms& still_terms;  // at least as many terms as bounces, if there is a still mesh
    TransferLayout layout;
    std::optional<TransferLayout> gloss_layout;  // if any vertex of either mesh is glossy
};

// Adds num_bounces bounces to the estimates of both halves, by the same rays.
// halves   in: [C][V]; out: [channels · C][V]
// gloss    in: [O · C'][R]; out: [channels · O · C'][R]
// terms    receives those of the bounces, unless nullptr
// returns  how many rays hit a triangle from behind
uint64_t add_bounces(const PoseBounces& bounces, uint32_t num_bounces,
                     std::array<std::vector<float>, 2>& halves,
                     std::array<std::vector<float>, 2>& gloss, StillTerms* terms);

}  // namespace paim
