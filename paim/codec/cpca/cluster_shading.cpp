// The radiance of vertices from that of their clusters' bases.
#include "paim/codec/cpca/cluster_shading.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <type_traits>
#include <utility>
#include <variant>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/vector_kernels.h"

namespace paim {

namespace {

constexpr size_t kPiece =
    512;  // most vertices of a piece, whose sums stay in the first-level cache
constexpr size_t kPadding = 16;  // vertices that kernels take at once
static_assert(kPiece % kPadding == 0);

// The values of the vertices, in their order, and zeros.
StoredValues sorted(const StoredValues& stored, std::span<const uint32_t> vertices) {
    return std::visit(
        [&](const auto& values) {
            std::remove_cvref_t<decltype(values)> result(vertices.size() + kPadding);
            std::transform(vertices.begin(), vertices.end(), result.begin(),
                           [&](uint32_t v) { return values[v]; });
            return StoredValues(std::move(result));
        },
        stored.values());
}

// The radiance of a cluster's rows, by channel.
class Rows {
  public:
    explicit Rows(std::span<const Vec3f> rows) {
        for (Eigen::Index channel = 0; channel < 3; ++channel) {
            for (size_t j = 0; j < rows.size(); ++j) values_[channel][j] = rows[j][channel];
        }
    }
    float mean(size_t channel) const { return values_[channel][0]; }
    const float* components(size_t channel) const { return values_[channel].data() + 1; }

  private:
    std::array<std::array<float, 1 + kMaxClusterComponents>, 3> values_;
};

}  // namespace

ClusterShading::ClusterShading(const VertexClusters& clusters)
    : num_rows_(clusters.num_rows()),
      rows_per_cluster_(clusters.rows_per_cluster()),
      vertices_(clusters.cluster.size()) {
    PAIM_CHECK_LE(clusters.num_components, kMaxClusterComponents);
    std::vector<uint32_t> next(size_t{clusters.num_clusters} + 1);
    for (const uint32_t cluster : clusters.cluster) ++next[cluster + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (uint32_t c = 0; c < clusters.num_clusters; ++c) {
        for (uint32_t first = next[c]; first < next[c + 1]; first += kPiece) {
            pieces_.push_back({c, first, std::min<uint32_t>(kPiece, next[c + 1] - first)});
        }
    }
    for (uint32_t v = 0; v < vertices_.size(); ++v) vertices_[next[clusters.cluster[v]]++] = v;
    for (const StoredValues& values : clusters.coefficients) {
        PAIM_CHECK_EQ(values.size(), vertices_.size());
        coefficients_.push_back(sorted(values, vertices_));
    }
}

void ClusterShading::shade_piece(const Piece& piece, std::span<const Vec3f> basis_radiance,
                                 std::span<const StoredValues> coefficients, const Albedo& albedo,
                                 std::span<Vec3f> radiance, VectorUnit unit) const {
    const Rows rows(
        basis_radiance.subspan(size_t{piece.cluster} * rows_per_cluster_, 1 + coefficients.size()));
    std::array<std::array<float, kPiece>, 3> sums;
    // The values after those of the piece are of other clusters, and their sums are not used.
    const size_t padded = (piece.count + kPadding - 1) / kPadding * kPadding;
    for (size_t channel = 0; channel < 3; ++channel) {
        std::fill_n(sums[channel].begin(), padded, rows.mean(channel));
    }
    if (unit == VectorUnit::plain) {
        for (size_t channel = 0; channel < 3; ++channel) {
            for (size_t j = 0; j < coefficients.size(); ++j) {
                for (size_t n = 0; n < piece.count; ++n) {
                    sums[channel][n] +=
                        rows.components(channel)[j] * coefficients[j][piece.first + n];
                }
            }
        }
    } else {
        const VectorKernels& use = vector_kernels(unit);
        for (size_t j = 0; j < coefficients.size();) {
            const Columns columns = columns_from(coefficients, j, piece.first);
            for (size_t channel = 0; channel < 3; ++channel) {
                use.add(columns, rows.components(channel) + j, sums[channel].data(), padded);
            }
            j += columns.count;
        }
    }
    const uint32_t* const vertices = vertices_.data() + piece.first;
    if (albedo.values.size() == 1) {
        const Vec3f factor = albedo.values[0];
        for (size_t n = 0; n < piece.count; ++n) {
            radiance[vertices[n]] = factor.cwiseProduct(Vec3f(sums[0][n], sums[1][n], sums[2][n]));
        }
        return;
    }
    for (size_t n = 0; n < piece.count; ++n) {
        const uint32_t v = vertices[n];
        radiance[v] = albedo.values[v].cwiseProduct(Vec3f(sums[0][n], sums[1][n], sums[2][n]));
    }
}

void ClusterShading::shade(std::span<const Vec3f> basis_radiance, uint32_t num_components,
                           const Albedo& albedo, std::span<Vec3f> radiance, VectorUnit unit) const {
    PAIM_CHECK_EQ(basis_radiance.size(), size_t{num_rows_});
    const auto coefficients =
        std::span(coefficients_).first(std::min<size_t>(num_components, coefficients_.size()));
    PAIM_CHECK_EQ(radiance.size(), vertices_.size());
    constexpr size_t kPiecesATask = 16;
    parallel_for(pieces_.size(), kPiecesATask, [&](size_t begin, size_t end) {
        for (size_t j = begin; j < end; ++j) {
            shade_piece(pieces_[j], basis_radiance, coefficients, albedo, radiance, unit);
        }
    });
}

}  // namespace paim
