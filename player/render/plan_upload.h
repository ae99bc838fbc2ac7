// Plans how a coded mesh is laid out in textures.
#pragma once

#include "player/render/upload_plan.h"

namespace paim::player {

// Within the limits. Throws Error(unsupported) if a texture of at most max_texture_size by
// max_texture_size cannot hold an attribute, naming the components that would fit, or if the player
// does not draw this codec.
UploadPlan plan_upload(const CodedMesh& mesh, const DecodeLimits& limits, int max_texture_size);

}  // namespace paim::player
