// What glossy transfer will be and take, known before the bake.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compressor/bake_input.h"

namespace paim {

struct GlossPlan {
    TransferLayout layout;
    uint64_t num_rows = 0;        // of the poses (mesh/materials.h)
    uint64_t num_still_rows = 0;  // of the still meshes
    uint32_t bounces = 0;
    // What the bands leave out of the reflection of each BRDF, for users, if that can be seen.
    std::vector<std::string> left_out = {};

    // Of its transfer (f32) and noise (f16) in the file of a pose.
    uint64_t pose_file_bytes() const { return 6 * num_rows * layout.num_planes(); }
    // Of the gloss while poses or still meshes are baked, whichever is more.
    uint64_t memory_bytes() const;
};

// Chooses the bands that the options leave open; those who follow the plan set them in the options, so
// that nobody chooses them again. Nothing if no material is glossy. Errors: those of parse_brdf().
std::optional<GlossPlan> plan_gloss(const BakeInput& input, const BakeOptions& options);

// What keeps the gloss of still meshes among poses that have none, as a phrase.
std::string how_to_keep_still_gloss();

// Lines for users: what the plan takes for this many poses, or that the gloss of still meshes alone will not
// be encoded, and what its bands leave out.
std::vector<std::string> gloss_notes(const GlossPlan& plan, uint64_t num_poses);

}  // namespace paim
