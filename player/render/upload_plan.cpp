// Texel counts and texture limits.
#include "player/render/upload_plan.h"

#include <algorithm>
#include <limits>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "player/gl/data_texture.h"

namespace paim::player {

namespace {

uint32_t groups(uint32_t num_coefficients) {
    return (num_coefficients + kGroupSize - 1) / kGroupSize;
}

// Shaders count texels in 32-bit integers.
int64_t capacity(int max_texture_size) {
    return std::min<int64_t>(int64_t{max_texture_size} * max_texture_size,
                             std::numeric_limits<int32_t>::max());
}

void require_fit(const char* part, uint32_t num_components, int64_t num_texels,
                 int max_texture_size) {
    const int64_t available = capacity(max_texture_size);
    if (num_texels <= available) return;
    const int64_t component_texels = num_texels / num_components;
    throw_unsupported(
        "{} components of {} need {} texels, this driver's largest texture (GL_MAX_TEXTURE_SIZE "
        "{}) "
        "holds {}: {} components would fit",
        num_components, part, num_texels, max_texture_size, available,
        available / component_texels);
}

// Texels of the largest texture that transfer takes, where every vertex has its own.
int64_t largest_of_vertices(const Model& model, const UploadPlan& plan, int max_texture_size) {
    const int64_t transfer = transfer_texels(model, plan.transfer_components, plan.layout.bands);
    const int64_t mean = int64_t{plan.num_groups()} * model.topology.num_vertices;
    require_fit("transfer", plan.transfer_components, transfer, max_texture_size);
    if (mean > capacity(max_texture_size)) {
        throw_unsupported(
            "the mean transfer of {} vertices needs {} texels, this driver's largest texture "
            "(GL_MAX_TEXTURE_SIZE {}) holds {}: lower --bands",
            model.topology.num_vertices, mean, max_texture_size, capacity(max_texture_size));
    }
    return std::max({transfer, mean, int64_t{plan.transfer_components}});
}

// Texels of the largest texture that transfer takes where vertices share the bases of clusters.
int64_t largest_of_clusters(const Model& model, const UploadPlan& plan, int max_texture_size) {
    // Textures hold their indices in 16 bits.
    const uint32_t num_clusters = model.clusters.num_clusters;
    PAIM_CHECK_LE(num_clusters, kMaxClusters);
    const int64_t coefficients = int64_t{plan.cluster_groups()} * model.topology.num_vertices;
    const int64_t products = int64_t{plan.product_texels()} * num_clusters;
    const int64_t largest =
        std::max({coefficients, products, int64_t{model.topology.num_vertices}});
    if (largest > capacity(max_texture_size)) {
        throw_unsupported(
            "{} components of {} clusters and {} vertices need {} texels, this driver's largest "
            "texture (GL_MAX_TEXTURE_SIZE {}) holds {}: lower --cluster-components",
            plan.cluster_components, num_clusters, model.topology.num_vertices, largest,
            max_texture_size, capacity(max_texture_size));
    }
    return largest;
}

}  // namespace

int64_t geometry_texels(const Model& model, uint32_t num_components) {
    return int64_t{std::min(num_components, model.geometry.num_components)} *
           model.topology.num_vertices;
}

int64_t transfer_texels(const Model& model, uint32_t num_components, uint32_t bands) {
    const uint32_t used = std::min(bands, model.layout.bands);
    return int64_t{std::min(num_components, model.transfer.num_components)} *
           model.layout.channels * groups(used * used) * model.topology.num_vertices;
}

UploadPlan plan_upload(const Model& model, const DecodeLimits& limits, int max_texture_size) {
    UploadPlan plan;
    plan.layout = model.layout;
    plan.layout.bands = std::min(limits.bands, model.layout.bands);
    plan.geometry_components = std::min(limits.geometry_components, model.geometry.num_components);
    plan.transfer_components = std::min(limits.transfer_components, model.transfer.num_components);
    plan.cluster_components = std::min(limits.cluster_components, model.clusters.num_components);
    plan.groups_per_channel = groups(plan.layout.num_coefficients());

    const int64_t geometry = geometry_texels(model, plan.geometry_components);
    require_fit("geometry", plan.geometry_components, geometry, max_texture_size);
    const int64_t transfer = model.clusters.empty()
                                 ? largest_of_vertices(model, plan, max_texture_size)
                                 : largest_of_clusters(model, plan, max_texture_size);
    const int64_t largest = std::max({geometry, transfer, int64_t{plan.geometry_components},
                                      int64_t{model.topology.num_vertices}});
    plan.width_log2 = gl::fitting_width_log2(largest, max_texture_size);
    return plan;
}

}  // namespace paim::player
