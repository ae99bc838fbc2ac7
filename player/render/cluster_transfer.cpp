// Clusters, coefficients, light products.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "player/render/cluster_transfer.h"

#include <fmt/format.h>

#include <algorithm>

#include "player/render/value_textures.h"

namespace paim::player {

namespace {

using gl::DataTexture;
using gl::TexelFormat;

std::span<const StoredValues> arrays_of(const VertexClusters& clusters, const UploadPlan& plan) {
    return std::span(clusters.coefficients).first(plan.cluster_components);
}

FormatSplit split_of(const VertexClusters& clusters, const UploadPlan& plan) {
    return split_by_format(arrays_of(clusters, plan), TexelFormat::rgba32f);
}

DataTexture upload_indices(const VertexClusters& clusters, const UploadPlan& plan) {
    const auto num_vertices = static_cast<int64_t>(clusters.cluster.size());
    DataTexture texture("the clusters", TexelFormat::r16i, plan.width_log2,
                        at_least_one(num_vertices));
    if (num_vertices == 0) return texture;
    texture.upload([&](int64_t first, std::span<int16_t> out) {
        const uint32_t* from = clusters.cluster.data() + first;
        std::transform(from, from + out.size(), out.begin(),
                       [](uint32_t cluster) { return static_cast<int16_t>(cluster); });
    });
    return texture;
}

// Groups [begin, end) of four components; what is left of the last group is zero.
DataTexture upload_coefficients(const VertexClusters& clusters, const UploadPlan& plan,
                                uint32_t begin, uint32_t end, TexelFormat format) {
    const std::span<const StoredValues> arrays = arrays_of(clusters, plan);
    return upload_groups("the coefficients of clusters", format, plan.width_log2,
                         static_cast<uint32_t>(clusters.cluster.size()), end - begin,
                         [&](uint32_t group, uint32_t lane) {
                             const size_t j = size_t{begin + group} * kGroupSize + lane;
                             return j < arrays.size() ? Lane{&arrays[j], 0} : Lane{};
                         });
}

}  // namespace

ClusterTransfer::ClusterTransfer(const Model& model, const UploadPlan& plan)
    : clusters_(model.clusters),
      plan_(plan),
      light_(model),
      num_int16_groups_((split_of(clusters_, plan).num_int16 + kGroupSize - 1) / kGroupSize),
      cluster_(upload_indices(clusters_, plan)),
      int16_(upload_coefficients(clusters_, plan, 0, num_int16_groups_,
                                 split_of(clusters_, plan).int16)),
      int8_(upload_coefficients(clusters_, plan, num_int16_groups_, plan.cluster_groups(),
                                TexelFormat::rgba8i)),
      products_("the light products of clusters", TexelFormat::rgba32f, plan.width_log2,
                int64_t{clusters_.num_clusters} * plan.product_texels()) {
    scratch_.resize(size_t{clusters_.num_clusters} * plan.product_texels() * kGroupSize);
}

std::string ClusterTransfer::defines() const {
    return fmt::format("#define CLUSTERED\n#define coefficients_int16_sampler {}\n",
                       gl::sampler_type(int16_.format()));
}

uint64_t ClusterTransfer::size_bytes() const {
    return cluster_.size_bytes() + int16_.size_bytes() + int8_.size_bytes() +
           products_.size_bytes();
}

void ClusterTransfer::update_products(const Frame& frame, const LightCoefficients& light) {
    DecodeLimits limits = frame.limits;
    limits.bands = std::min(limits.bands, plan_.layout.bands);
    limits.transfer_components = std::min(limits.transfer_components, plan_.transfer_components);
    light_.basis_radiance(frame.time, limits, light, row_products_);
    const uint32_t stride = clusters_.rows_per_cluster();
    for (size_t c = 0; c < clusters_.num_clusters; ++c) {
        const Vec3f* rows = row_products_.data() + c * stride;
        float* to = scratch_.data() + c * plan_.product_texels() * kGroupSize;
        std::copy_n(rows[0].data(), 3, to);
        for (uint32_t j = 0; j < plan_.cluster_components; ++j) {
            float* group = to + (1 + 3 * (j / kGroupSize)) * kGroupSize + j % kGroupSize;
            for (uint32_t channel = 0; channel < 3; ++channel) {
                group[channel * kGroupSize] = rows[1 + j][channel];
            }
        }
    }
    products_.update(scratch_);
}

int ClusterTransfer::bind(const gl::Program& program, int unit, const Frame& frame,
                          const LightCoefficients& light) {
    update_products(frame, light);
    program.set_texture("cluster", unit++, cluster_.handle());
    program.set_texture("coefficients_int16", unit++, int16_.handle());
    program.set_texture("coefficients_int8", unit++, int8_.handle());
    program.set_texture("basis_radiance", unit++, products_.handle());
    const uint32_t components = std::min(frame.limits.cluster_components, plan_.cluster_components);
    const uint32_t groups = (components + kGroupSize - 1) / kGroupSize;
    const uint32_t int16_groups = std::min(groups, num_int16_groups_);
    program.set("product_texels", static_cast<int>(plan_.product_texels()));
    program.set("num_int16_groups", static_cast<int>(int16_groups));
    program.set("num_int8_groups", static_cast<int>(groups - int16_groups));
    return unit;
}

}  // namespace paim::player
