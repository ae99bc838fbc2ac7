// How a model is laid out in textures, and whether they hold it.
#pragma once

#include <cstdint>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim::player {

// Coefficients of one vertex in a texel.
constexpr uint32_t kGroupSize = 4;

struct UploadPlan {
    TransferLayout layout;         // of what can be shown: bands as limited
    uint32_t geometry_components;  // that are uploaded
    uint32_t
        transfer_components;  // that are uploaded; with clusters, that the bases are rebuilt from
    uint32_t cluster_components;  // that are uploaded; 0 without clusters
    uint32_t groups_per_channel;  // texels of one vertex and channel, without clusters
    int width_log2;               // of all textures

    uint32_t num_groups() const { return layout.channels * groups_per_channel; }
    uint32_t cluster_groups() const { return (cluster_components + kGroupSize - 1) / kGroupSize; }
    // Texels of the light products of a cluster: its mean, then the red, green and blue of every
    // four components.
    uint32_t product_texels() const { return 1 + 3 * cluster_groups(); }
};

// Texels of all components of the part, as if they were in one texture.
int64_t geometry_texels(const Model& model, uint32_t num_components);
int64_t transfer_texels(const Model& model, uint32_t num_components,
                        uint32_t bands);  // no clusters

// Plans the upload of the model as far as it is within the limits. Throws Error(unsupported) that names
// the texture limit, and the components that would fit, where a texture of at most max_texture_size
// by max_texture_size cannot hold a part.
UploadPlan plan_upload(const Model& model, const DecodeLimits& limits, int max_texture_size);

}  // namespace paim::player
