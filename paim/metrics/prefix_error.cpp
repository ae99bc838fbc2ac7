// Errors of the first components of a compressed animation.
#include "paim/metrics/prefix_error.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/point_groups.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

// Values [first, first + rows) of the mean and of every component, in steps.
void gather(const LowRank& matrix, size_t first, MatrixXd& values) {
    const auto fill = [&](const StoredValues& from, Index column) {
        from.for_each(first, static_cast<size_t>(values.rows()), [&](size_t j, float value) {
            values(static_cast<Index>(j - first), column) = double{value};
        });
    };
    fill(matrix.mean, 0);
    for (uint32_t k = 0; k < matrix.num_components; ++k) fill(matrix.components[k], 1 + Index{k});
}

// Products of the mean and the components with each other in one plane, in steps.
// metrics  of runs of points; empty: each point counts for itself
MatrixXd plane_gram(const LowRank& matrix, uint32_t plane, const std::vector<MatrixXd>& metrics) {
    const Index num_columns = 1 + Index{matrix.num_components};
    MatrixXd gram = MatrixXd::Zero(num_columns, num_columns);
    const size_t plane_begin = size_t{plane} * matrix.num_points;
    MatrixXd values;
    for (size_t c = 0; c < metrics.size(); ++c) {
        values.resize(metrics[c].rows(), num_columns);
        gather(matrix, plane_begin + c * static_cast<size_t>(metrics[c].rows()), values);
        gram.noalias() += values.transpose() * (metrics[c] * values);
    }
    if (!metrics.empty()) return gram;
    constexpr size_t kPointsAtOnce = 512;  // so that their values stay in the cache
    for (size_t n = 0; n < matrix.num_points; n += kPointsAtOnce) {
        const size_t count = std::min<size_t>(kPointsAtOnce, matrix.num_points - n);
        values.resize(static_cast<Index>(count), num_columns);
        gather(matrix, plane_begin + n, values);
        gram.noalias() += values.transpose() * values;
    }
    return gram;
}

// √(whole² + dropped / norm)
std::vector<double> add_in_squares(double whole, const std::vector<double>& dropped, double norm) {
    std::vector<double> errors;
    for (const double energy : dropped) {
        errors.push_back(std::hypot(whole, energy > 0.0 ? std::sqrt(energy / norm) : 0.0));
    }
    return errors;
}

// Quadratic forms, one for each group of points, by which squared errors of their values add up
// over the vertices: Σ_v a_v a_vᵀ, a_v the factors of vertex v. None if points are the vertices.
std::vector<MatrixXd> point_metrics(const TransferModel& transfer) {
    const std::optional<PointGroups> groups = transfer.point_groups();
    if (!groups) return {};
    const Index size = groups->factors.cols();
    std::vector<MatrixXd> metrics(groups->num_groups, MatrixXd::Zero(size, size));
    for (size_t v = 0; v < groups->group.size(); ++v) {
        const Eigen::VectorXd factors =
            groups->factors.row(static_cast<Index>(v)).transpose().cast<double>();
        metrics[groups->group[v]].noalias() += factors * factors.transpose();
    }
    return metrics;
}

}  // namespace

ComponentEnergy component_energy(const CodedMesh& mesh, Attribute attribute,
                                 const std::vector<double>& plane_weight) {
    const LowRank& matrix = mesh.attribute(attribute);
    PAIM_CHECK_EQ(plane_weight.size(), size_t{matrix.num_planes});
    const std::vector<MatrixXd> metrics =
        attribute == Attribute::transfer ? point_metrics(*mesh.transfer) : std::vector<MatrixXd>{};
    const Index num_columns = 1 + Index{matrix.num_components};
    std::vector<MatrixXd> planes(matrix.num_planes, MatrixXd::Zero(num_columns, num_columns));
    parallel_for(planes.size(), 1, [&](size_t j, size_t) {
        const auto plane = static_cast<uint32_t>(j);
        if (plane_weight[j] == 0.0) return;
        const double step = double{matrix.step(plane)};
        planes[j] = plane_weight[j] * step * step * plane_gram(matrix, plane, metrics);
    });
    MatrixXd energy = MatrixXd::Zero(num_columns, num_columns);
    for (const MatrixXd& gram : planes) energy += gram;

    // Multiplied by the products of weights over poses; the weight of the mean is 1.
    MatrixXd weights = MatrixXd::Ones(num_columns, Index{matrix.num_poses});
    for (Index k = 1; k < num_columns; ++k) {
        for (Index p = 0; p < weights.cols(); ++p) {
            weights(k, p) =
                double{matrix.weights[static_cast<size_t>((k - 1) * weights.cols() + p)]};
        }
    }
    energy = energy.cwiseProduct(weights * weights.transpose());
    ComponentEnergy result;
    result.decoded = energy.sum();
    result.dropped.assign(static_cast<size_t>(num_columns), 0.0);
    for (Index k = num_columns - 1; k > 0; --k) {
        const Index after = num_columns - 1 - k;
        const double more = energy(k, k) + 2.0 * energy.row(k).tail(after).sum();
        const auto j = static_cast<size_t>(k);
        result.dropped[j - 1] = result.dropped[j] + more;
    }
    return result;
}

ComponentEnergy usual_position_energy(const CodedMesh& mesh) {
    const std::vector<double> alike(3, 1.0);
    const uint32_t num_usual = mesh.positions.num_usual_components();
    if (num_usual == mesh.positions.num_components) {
        return component_energy(mesh, Attribute::geometry, alike);
    }
    CodedMesh usual = mesh;
    usual.positions.keep_components(num_usual);
    ComponentEnergy energy = component_energy(usual, Attribute::geometry, alike);
    energy.dropped.resize(1 + size_t{mesh.positions.num_components}, 0.0);
    return energy;
}

PrefixErrors prefix_errors(const CodedMesh& mesh, const std::optional<ErrorStatement>& statement) {
    const ErrorStatement whole = statement.value_or(ErrorStatement{});
    const bool named = whole.band_power == "flat" || whole.band_power == "natural";
    const std::optional<double> transfer_error =
        named ? whole.value("transfer_total_error") : std::nullopt;
    const std::optional<double> position_rms = whole.value("position_rms");

    const TransferLayout& layout = mesh.layout;
    const BandPower spectrum = parse_band_power(named ? whole.band_power : "flat", layout.in_bands);
    std::vector<double> weights(layout.num_planes());
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        weights[plane] = spectrum.weight(layout.input_band(plane));
    }
    const ComponentEnergy transfer = component_energy(mesh, Attribute::transfer, weights);
    // The norm of the bake, if the decoded transfer and its error are orthogonal.
    const double error_to_bake =
        transfer_error ? whole.value("transfer_deviation").value_or(0.0) : 0.0;
    const double share = error_to_bake < 1.0 ? 1.0 - error_to_bake * error_to_bake : 1.0;
    const ComponentEnergy geometry = usual_position_energy(mesh);
    const double num_positions = static_cast<double>(face_vertices(mesh.topology).size()) *
                                 static_cast<double>(mesh.num_poses());
    return {
        spectrum.name,
        add_in_squares(transfer_error.value_or(0.0), transfer.dropped, transfer.decoded / share),
        add_in_squares(position_rms.value_or(0.0), geometry.dropped, num_positions),
        transfer_error.has_value(), position_rms.has_value()};
}

}  // namespace paim
