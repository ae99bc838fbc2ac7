// Codec cpca in textures: clusters, coefficients, radiance of bases.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "player/render/cpca/cpca_textures.h"

#include <fmt/format.h>

#include <algorithm>

#include "paim/base/check.h"
#include "paim/base/error.h"

#include "player/render/value_textures.h"

namespace paim::player {

namespace {

using gl::DataTexture;
using gl::TexelFormat;

// The mesh's transfer is clustered (checked).
const VertexClusters& clusters_of(const CodedMesh& mesh) {
    const auto* const transfer = mesh.transfer.as<CpcaTransfer>();
    PAIM_CHECK(transfer != nullptr);
    return transfer->clusters;
}

constexpr CodecWords kWords{
    .codec = CpcaTransfer::kName,
    .option = "--cluster-components",
    .components = "cluster components",
    .description =
        "In files with clusters: number of components of its cluster that the transfer of a "
        "vertex is summed from, 0 or more (default: all)",
    .shared_work = "the bases of clusters",
    .shared_work_json = "cluster_multiply_adds",
};

uint32_t cluster_groups(const UploadPlan& plan) {
    return (plan.vertex_components + kGroupSize - 1) / kGroupSize;
}

// Texels of the radiance of a cluster's basis: its mean, then the red, green and blue of every four
// components.
uint32_t basis_texels(const UploadPlan& plan) {
    return 1 + 3 * cluster_groups(plan);
}

// Of the largest texture that transfer takes.
int64_t largest_cpca_texture(const CodedMesh& mesh, const UploadPlan& plan, int max_texture_size) {
    // Textures hold clusters' numbers in 16 bits.
    const uint32_t num_clusters = clusters_of(mesh).num_clusters;
    PAIM_CHECK_LE(num_clusters, kMaxClusters);
    const int64_t num_vertices = mesh.topology.num_vertices;
    const int64_t largest = std::max({int64_t{cluster_groups(plan)} * num_vertices,
                                      int64_t{basis_texels(plan)} * num_clusters, num_vertices});
    if (largest > texel_capacity(max_texture_size)) {
        throw_unsupported(
            "{} components of {} clusters and {} vertices need {} texels, this driver's largest "
            "texture (GL_MAX_TEXTURE_SIZE {}) holds {}: lower {}",
            plan.vertex_components, num_clusters, num_vertices, largest, max_texture_size,
            texel_capacity(max_texture_size), kWords.option);
    }
    return largest;
}

std::span<const StoredValues> arrays_of(const VertexClusters& clusters, const UploadPlan& plan) {
    return std::span(clusters.coefficients).first(plan.vertex_components);
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

TransferUploader cpca_uploader() {
    return {CpcaTransfer::kName, largest_cpca_texture,
            [](const CodedMesh& mesh, const UploadPlan& plan) -> std::unique_ptr<TransferTextures> {
                return std::make_unique<CpcaTextures>(mesh, plan);
            },
            kWords};
}

CpcaTextures::CpcaTextures(const CodedMesh& mesh, const UploadPlan& plan)
    : clusters_(clusters_of(mesh)),
      plan_(plan),
      player_(*mesh.transfer.as<CpcaTransfer>(), mesh.layout),
      num_int16_groups_((split_of(clusters_, plan).num_int16 + kGroupSize - 1) / kGroupSize),
      cluster_(upload_indices(clusters_, plan)),
      int16_(upload_coefficients(clusters_, plan, 0, num_int16_groups_,
                                 split_of(clusters_, plan).int16)),
      int8_(upload_coefficients(clusters_, plan, num_int16_groups_, cluster_groups(plan),
                                TexelFormat::rgba8i)),
      basis_radiance_("the radiance of bases", TexelFormat::rgba32f, plan.width_log2,
                      int64_t{clusters_.num_clusters} * basis_texels(plan)) {
    scratch_.resize(size_t{clusters_.num_clusters} * basis_texels(plan) * kGroupSize);
}

std::string CpcaTextures::defines() const {
    return fmt::format("#define coefficients_int16_sampler {}\n",
                       gl::sampler_type(int16_.format()));
}

uint64_t CpcaTextures::size_bytes() const {
    return cluster_.size_bytes() + int16_.size_bytes() + int8_.size_bytes() +
           basis_radiance_.size_bytes();
}

void CpcaTextures::update_basis_radiance(double time, DecodeLimits limits,
                                         const LightCoefficients& light) {
    limits.bands = std::min(limits.bands, plan_.layout.in_bands);
    limits.transfer_components = std::min(limits.transfer_components, plan_.transfer_components);
    player_.basis_radiance(time, limits, light, row_radiance_);
    const uint32_t stride = clusters_.rows_per_cluster();
    for (size_t c = 0; c < clusters_.num_clusters; ++c) {
        const Vec3f* rows = row_radiance_.data() + c * stride;
        float* to = scratch_.data() + c * basis_texels(plan_) * kGroupSize;
        std::copy_n(rows[0].data(), 3, to);
        for (uint32_t j = 0; j < plan_.vertex_components; ++j) {
            float* group = to + (1 + 3 * (j / kGroupSize)) * kGroupSize + j % kGroupSize;
            for (uint32_t channel = 0; channel < 3; ++channel) {
                group[channel * kGroupSize] = rows[1 + j][channel];
            }
        }
    }
    basis_radiance_.update(scratch_);
}

int CpcaTextures::bind(const gl::Program& program, int unit, double time,
                       const DecodeLimits& limits, const LightCoefficients& light) {
    update_basis_radiance(time, limits, light);
    program.set_texture("cluster", unit++, cluster_.handle());
    program.set_texture("coefficients_int16", unit++, int16_.handle());
    program.set_texture("coefficients_int8", unit++, int8_.handle());
    program.set_texture("basis_radiance", unit++, basis_radiance_.handle());
    const uint32_t components = std::min(limits.vertex_components, plan_.vertex_components);
    const uint32_t groups = (components + kGroupSize - 1) / kGroupSize;
    const uint32_t int16_groups = std::min(groups, num_int16_groups_);
    program.set("product_texels", static_cast<int>(basis_texels(plan_)));
    program.set("num_int16_groups", static_cast<int>(int16_groups));
    program.set("num_int8_groups", static_cast<int>(groups - int16_groups));
    return unit;
}

}  // namespace paim::player
