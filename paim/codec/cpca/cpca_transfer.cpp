// Codec cpca: its sections, its cost, and the rebuilding of vertices from bases.
// Based on: Sloan, Hall, Hart and Snyder 2003 (see the header)
#include "paim/codec/cpca/cpca_transfer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/parallel.h"
#include "paim/codec/cpca/basis_table.h"
#include "paim/codec/cpca/cpca_player.h"
#include "paim/codec/point_groups.h"

namespace paim {

namespace {

// The largest magnitude of coefficients, at least 1, because scaled rows are values, too. For
// integers it is the largest of their type, without looking at the values.
double largest_coefficient(const StoredValues& values) {
    if (!values.holds_floats()) {
        return largest_integer(values.holds_i8() ? Precision::i8 : Precision::i16);
    }
    double largest = 1.0;
    for (const float value : values.floats()) {
        largest = std::max(largest, std::isfinite(value) ? std::abs(double{value}) : HUGE_VAL);
    }
    return largest;
}

}  // namespace

std::unique_ptr<TransferModel> CpcaTransfer::clone() const {
    return std::make_unique<CpcaTransfer>(*this);
}

void CpcaTransfer::vertices_from_points(std::span<const float> points, uint32_t num_components,
                                        std::span<float> out) const {
    BasisTable table;
    table.assign(points, clusters.scales);
    sum_all(clusters, table, num_components, out);
}

std::unique_ptr<TransferPlayer> CpcaTransfer::make_player(const TransferLayout& layout) const {
    return std::make_unique<CpcaPlayer>(*this, layout);
}

FrameCost CpcaTransfer::cost(const TransferLayout& layout, const DecodeLimits& limits,
                             bool coloured_light) const {
    const TransferLayout used = layout.with_bands(limits.bands);
    const uint32_t over_time = std::min(limits.transfer_components, matrix.num_components);
    const auto of = [&](uint32_t num_components) {
        return cpca_cost(used, clusters.num_clusters, num_components, over_time, coloured_light);
    };
    FrameCost cost = of(std::min(limits.vertex_components, clusters.num_components));
    // All components of the bases are lit, even if vertices use only some of them.
    cost.cpu_per_frame = of(clusters.num_components).cpu_per_frame;
    return cost;
}

uint64_t CpcaTransfer::vertex_bytes(uint32_t num_components) const {
    uint64_t bytes = sizeof(uint16_t);  // of the cluster's number
    for (uint32_t j = 0; j < num_components; ++j) {
        const StoredValues& values = clusters.coefficients[j];
        bytes += values.holds_floats() ? 4 : values.holds_i8() ? 1 : 2;
    }
    return bytes * clusters.cluster.size() +
           sizeof(float) * uint64_t{clusters.num_clusters} * (num_components + 1);
}

double CpcaTransfer::vertex_gain() const {
    std::vector<double> largest{1.0};  // [1 + components] of a basis; that of the mean is always 1
    for (const StoredValues& values : clusters.coefficients) {
        largest.push_back(largest_coefficient(values));
    }
    double gain = 0.0;
    for (uint32_t c = 0; c < clusters.num_clusters; ++c) {
        double sum = 0.0;
        for (uint32_t row = 0; row < clusters.rows_per_cluster(); ++row) {
            sum += largest[row] *
                   std::abs(double{clusters.scales[size_t{c} * clusters.rows_per_cluster() + row]});
        }
        gain = std::max(gain, sum);
    }
    return gain;
}

std::optional<PointGroups> CpcaTransfer::point_groups() const {
    const uint32_t num_rows = clusters.rows_per_cluster();
    PointGroups groups{clusters.num_clusters, clusters.cluster,
                       Eigen::MatrixXf(num_vertices(), num_rows), true};
    for (uint32_t row = 0; row < num_rows; ++row) {
        for (size_t v = 0; v < clusters.cluster.size(); ++v) {
            const float coefficient = row == 0 ? 1.0f : clusters.coefficients[row - 1][v];
            const float scale = clusters.scales[size_t{clusters.cluster[v]} * num_rows + row];
            // Beyond the range of floats where the points are zero.
            constexpr double kMost = std::numeric_limits<float>::max();
            groups.factors(static_cast<Eigen::Index>(v), row) =
                static_cast<float>(std::clamp(double{coefficient} * double{scale}, -kMost, kMost));
        }
    }
    return groups;
}

std::vector<NamedNumber> CpcaTransfer::numbers() {
    return {{"clusters", &clusters.num_clusters, 1, kMaxClusters, nullptr},
            {"cluster_components", &clusters.num_components, 0, kMaxClusterComponents,
             &DecodeLimits::vertex_components}};
}

uint32_t CpcaTransfer::start(uint32_t num_vertices) {
    num_stored_vertices_ = num_vertices;
    clusters.coefficients.resize(clusters.num_components);
    return clusters.num_rows();
}

std::vector<SectionRow> CpcaTransfer::sections() {
    const uint32_t num_vertices =
        clusters.cluster.empty() ? num_stored_vertices_ : this->num_vertices();
    std::vector<SectionRow> rows{
        {"CIDX", 0, 1, num_vertices, true, SmallNumbers{&clusters.cluster, clusters.num_clusters}},
        {"CSCL", 0, clusters.num_clusters, clusters.rows_per_cluster(), false, &clusters.scales}};
    for (uint32_t j = 0; j < clusters.num_components; ++j) {
        rows.push_back({"CCOE", j, 1, num_vertices, true, &clusters.coefficients[j]});
    }
    return rows;
}

FrameCost cpca_cost(const TransferLayout& layout, uint32_t num_clusters, uint32_t num_components,
                    uint32_t num_time_components, bool coloured_light) {
    const uint64_t channels = num_radiance_channels(layout, coloured_light);
    const uint64_t functions = uint64_t{num_clusters} * (uint64_t{num_components} + 1);
    const uint64_t outgoing = layout.num_outgoing();
    return {channels * outgoing * (uint64_t{num_components} + 1), 0,
            functions * (channels * outgoing * layout.num_coefficients() +
                         uint64_t{num_time_components} * layout.num_planes())};
}

}  // namespace paim
