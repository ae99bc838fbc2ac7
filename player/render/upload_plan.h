// How a coded mesh is laid out in textures, and whether they hold it.
#pragma once

#include <cstdint>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"

namespace paim::player {

// Values of one vertex in a texel.
constexpr uint32_t kGroupSize = 4;

// Texels that the coefficients of one vertex and channel take.
inline uint32_t groups_of(const TransferLayout& layout) {
    return (layout.num_coefficients() + kGroupSize - 1) / kGroupSize;
}

struct UploadPlan {
    TransferLayout layout;             // of what can be shown: bands as limited
    uint32_t geometry_components = 0;  // that are uploaded
    uint32_t transfer_components = 0;  // likewise, over the poses
    uint32_t vertex_components = 0;    // likewise, of every vertex
    int width_log2 = 0;                // of all textures

    uint32_t groups_per_channel() const { return groups_of(layout); }
    uint32_t num_groups() const { return layout.channels * groups_per_channel(); }
};

// Texels of all components of the positions, as if they were in one texture.
int64_t geometry_texels(const CodedMesh& mesh, uint32_t num_components);

// Texels that a texture of at most max_texture_size by max_texture_size holds.
int64_t texel_capacity(int max_texture_size);

// Error (unsupported) that names the limit, and the components that would fit, if it holds fewer.
void require_fit(const char* attribute, uint32_t num_components, int64_t num_texels,
                 int max_texture_size);

}  // namespace paim::player
