// The noise of a bake that a decoder lets through.
// Based on: Efron 2004 (see the header)
#include "paim/metrics/noise_covariance.h"

#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

constexpr Index kColumnsAtOnce = 1024;
// Fixed, so that sums do not depend on how a processor's caches are used.
constexpr size_t kMembersAtOnce = 64;

// The columns of the members, [K'][members].
MatrixXf gather(const MatrixXf& vertices, std::span<const uint32_t> members) {
    MatrixXf values(vertices.rows(), static_cast<Index>(members.size()));
    for (size_t j = 0; j < members.size(); ++j) {
        values.col(static_cast<Index>(j)) = vertices.col(members[j]);
    }
    return values;
}

// Calls body(first, members) for runs of the members of a group.
template <typename Body>
void for_each_run_of_members(std::span<const uint32_t> members, const Body& body) {
    for (size_t first = 0; first < members.size(); first += kMembersAtOnce) {
        body(static_cast<Index>(first),
             members.subspan(first, std::min(kMembersAtOnce, members.size() - first)));
    }
}

// Calls body(run, first, count) for runs of `size` columns, in parallel.
template <typename Body>
void for_each_run(Index size, const Body& body) {
    const auto num_runs = static_cast<size_t>((size + kColumnsAtOnce - 1) / kColumnsAtOnce);
    parallel_for(num_runs, 1, [&](size_t j, size_t) {
        const Index first = static_cast<Index>(j) * kColumnsAtOnce;
        body(j, first, std::min(kColumnsAtOnce, size - first));
    });
}

}  // namespace

NoiseCovariance::NoiseCovariance(const TransferLayout& layout, uint32_t num_vertices,
                                 const BandPower& spectrum, const MatrixXd& span,
                                 std::optional<DecodedPoints> points)
    : layout_(layout),
      spectrum_(spectrum),
      span_(span.cast<float>()),
      points_(std::move(points)),
      row_shares_(layout.in_bands),
      axis_shares_(layout.in_bands) {
    auto num_rows = static_cast<Index>(num_vertices);
    if (points_) {
        PAIM_CHECK_EQ(points_->groups.group.size(), size_t{num_vertices});
        axes_.emplace(points_->groups);
        points_->groups = {};
        for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
            const auto along = points_along_span(plane);
            if (along) axes_->add_points(*along, spectrum.weight(layout.input_band(plane)));
        }
        axes_->orthonormalise_points();
        num_rows = Index{axes_->num_groups()} * axes_->num_vertex_axes();
        baked_coordinates_.setZero(axes_->num_point_axes(), static_cast<Index>(num_vertices));
        noise_coordinates_ = baked_coordinates_;
    }
    row_energy_.setZero(span_.cols(), num_rows);
    row_noise_ = row_energy_;
}

void NoiseCovariance::find_along_span(const Plane& values, MatrixXf& along) const {
    along.resize(span_.cols(), values.rows());
    for_each_run(values.rows(), [&](size_t, Index first, Index count) {
        const MatrixXf of_run = values.middleRows(first, count) * span_;
        along.middleCols(first, count) = of_run.transpose();
    });
}

std::optional<MatrixXf> NoiseCovariance::points_along_span(uint32_t plane) const {
    if (!points_) return {};
    const std::optional<MatrixXf> points = points_->decode(plane);
    if (!points) return {};
    MatrixXf along;
    find_along_span(*points, along);
    return along;
}

MatrixXf NoiseCovariance::rows_of(const MatrixXf& vertices) const {
    const Index size = axes_->num_vertex_axes();
    MatrixXf rows = MatrixXf::Zero(vertices.rows(), Index{axes_->num_groups()} * size);
    parallel_for(axes_->num_groups(), 1, [&](size_t j, size_t) {
        const auto g = static_cast<uint32_t>(j);
        auto of_group = rows.middleCols(Index{g} * size, size);
        for_each_run_of_members(axes_->members(g), [&](Index first, auto members) {
            const auto axes =
                axes_->vertex_axes(g).middleCols(first, static_cast<Index>(members.size()));
            of_group.noalias() += gather(vertices, members) * axes.transpose();
        });
    });
    return rows;
}

void NoiseCovariance::survey(uint32_t plane, const Plane& baked, const Plane& noise) {
    PAIM_CHECK(row_class_.empty());
    is_surveyed_ = true;
    find_along_span(baked, baked_along_);
    find_along_span(noise, noise_along_);
    const auto add_squares = [](MatrixXd& sums, const MatrixXf& rows) {
        for_each_run(rows.cols(), [&](size_t, Index first, Index count) {
            sums.middleCols(first, count) +=
                rows.middleCols(first, count).cast<double>().cwiseAbs2();
        });
    };
    if (!axes_) {
        add_squares(row_energy_, baked_along_);
        add_squares(row_noise_, noise_along_);
        return;
    }
    add_squares(row_energy_, rows_of(baked_along_));
    add_squares(row_noise_, rows_of(noise_along_));
    const auto points = points_along_span(plane);
    PAIM_CHECK(points.has_value());
    survey_points(*points, spectrum_.weight(layout_.input_band(plane)));
}

void NoiseCovariance::survey_points(const MatrixXf& points, double weight) {
    parallel_for(axes_->num_groups(), 1, [&](size_t j, size_t) {
        const auto g = static_cast<uint32_t>(j);
        if (!axes_->has_point_axes(g)) return;
        const MatrixXf axes = static_cast<float>(weight) * axes_->point_axes(g, points);
        for_each_run_of_members(axes_->members(g), [&](Index first, auto members) {
            const auto add = [&](MatrixXf& coordinates, const MatrixXf& values) {
                coordinates.middleCols(axes_->begin(g) + first, static_cast<Index>(members.size()))
                    .noalias() += axes.transpose() * gather(values, members);
            };
            add(baked_coordinates_, baked_along_);
            add(noise_coordinates_, noise_along_);
        });
    });
}

void NoiseCovariance::finish_survey() {
    PAIM_CHECK(is_surveyed_);
    row_class_.resize(static_cast<size_t>(row_energy_.size()));
    for (Index j = 0; j < row_energy_.size(); ++j) {
        row_class_[static_cast<size_t>(j)] =
            NoiseShares::class_of(row_energy_.data()[j], row_noise_.data()[j]);
    }
    row_energy_.resize(0, 0);
    row_noise_.resize(0, 0);
    if (axes_) compare_coordinates();
}

// Shares of the coordinates along the point axes. Of the coordinates of the noise, what the vertex
// axes do not have is left.
void NoiseCovariance::compare_coordinates() {
    const Index size = axes_->num_point_axes();
    axis_class_.resize(static_cast<size_t>(Index{axes_->num_groups()} * size));
    NoiseShares shares;
    for (uint32_t g = 0; g < axes_->num_groups(); ++g) {
        if (!axes_->has_point_axes(g)) continue;
        const auto num_members = static_cast<Index>(axes_->members(g).size());
        const auto baked = baked_coordinates_.middleCols(axes_->begin(g), num_members);
        const MatrixXf decoded = axes_->decoded_coordinates(g);
        auto noise = noise_coordinates_.middleCols(axes_->begin(g), num_members);
        for (Index j = 0; j < size; ++j) {
            Eigen::RowVectorXd x = baked.row(j).cast<double>();
            Eigen::RowVectorXd x_hat = decoded.row(j).cast<double>();
            if (axes_->is_affine()) {
                x.array() -= x.mean();
                x_hat.array() -= x_hat.mean();
            }
            const double energy = x.squaredNorm();
            const uint8_t c =
                NoiseShares::class_of(energy, noise.row(j).cast<double>().squaredNorm());
            axis_class_[static_cast<size_t>(Index{g} * size + j)] = c;
            shares.add_values(c, x_hat.dot(x), energy);
        }
        MatrixXf along_vertex_axes = MatrixXf::Zero(size, axes_->num_vertex_axes());
        for_each_run_of_members(axes_->members(g), [&](Index first, auto members) {
            const auto count = static_cast<Index>(members.size());
            along_vertex_axes.noalias() +=
                noise.middleCols(first, count) *
                axes_->vertex_axes(g).middleCols(first, count).transpose();
        });
        noise.noalias() -= along_vertex_axes * axes_->vertex_axes(g);
    }
    baked_coordinates_.resize(0, 0);
    for (NoiseShares& of_band : axis_shares_) of_band = shares;
}

void NoiseCovariance::add(uint32_t plane, const Plane& baked, const Plane& noise,
                          const Plane& decoded) {
    if (row_class_.empty()) finish_survey();
    const uint32_t band = layout_.input_band(plane);
    find_along_span(baked, baked_along_);
    find_along_span(noise, noise_along_);
    find_along_span(decoded, decoded_along_);
    if (!axes_) {
        add_rows(band, baked_along_, noise_along_, decoded_along_);
        return;
    }
    add_rows(band, rows_of(baked_along_), rows_of(noise_along_), rows_of(decoded_along_));
    if (const auto points = points_along_span(plane)) add_coordinates(band, *points);
}

void NoiseCovariance::add_rows(uint32_t band, const MatrixXf& baked, const MatrixXf& noise,
                               const MatrixXf& decoded) {
    std::vector<NoiseShares> runs(
        static_cast<size_t>((baked.cols() + kColumnsAtOnce - 1) / kColumnsAtOnce));
    for_each_run(baked.cols(), [&](size_t run, Index first, Index count) {
        NoiseShares shares;
        for (Index j = first * baked.rows(); j < (first + count) * baked.rows(); ++j) {
            const double x = baked.data()[j], d = noise.data()[j], x_hat = decoded.data()[j];
            const int c = row_class_[static_cast<size_t>(j)];
            shares.add_values(c, x_hat * x, x * x);
            shares.add_noise(c, d * d);
        }
        runs[run] = shares;
    });
    for (const NoiseShares& run : runs) row_shares_[band].add(run);
}

void NoiseCovariance::add_coordinates(uint32_t band, const MatrixXf& points) {
    const Index size = axes_->num_point_axes();
    MatrixXd sums = MatrixXd::Zero(size, Index{axes_->num_groups()});
    parallel_for(axes_->num_groups(), 1, [&](size_t j, size_t) {
        const auto g = static_cast<uint32_t>(j);
        if (!axes_->has_point_axes(g)) return;
        const MatrixXf axes = axes_->point_axes(g, points);
        for_each_run_of_members(axes_->members(g), [&](Index first, auto members) {
            const MatrixXf here = axes.transpose() * gather(noise_along_, members);
            const MatrixXf& coordinates = noise_coordinates_;
            sums.col(Index{g}) += coordinates.middleCols(axes_->begin(g) + first, here.cols())
                                      .cast<double>()
                                      .cwiseProduct(here.cast<double>())
                                      .rowwise()
                                      .sum();
        });
    });
    for (Index j = 0; j < sums.size(); ++j) {
        axis_shares_[band].add_noise(axis_class_[static_cast<size_t>(j)], sums.data()[j]);
    }
}

std::vector<double> NoiseCovariance::result() const {
    std::vector<double> covariance;
    for (uint32_t l = 0; l < layout_.in_bands; ++l) {
        covariance.push_back(row_shares_[l].passing() + axis_shares_[l].passing());
    }
    return covariance;
}

uint64_t NoiseCovariance::bytes(uint64_t num_vertices, uint64_t span_size, uint64_t num_points,
                                uint64_t num_points_each) {
    const uint64_t num_rows = num_points > 0 ? num_points : num_vertices;
    // Baked, noise and decoded values along the span; classes of rows.
    uint64_t floats = 3 * span_size * num_vertices;
    uint64_t bytes = span_size * num_rows;
    if (num_points > 0) {
        PAIM_CHECK_LE(1u, num_points_each);
        // The same of rows, and the points; coordinates of the vertices.
        floats += 4 * span_size * num_points + 2 * num_points_each * num_vertices;
        const uint64_t num_groups = (num_points + num_points_each - 1) / num_points_each;
        bytes += GroupAxes::bytes(num_vertices, num_groups, num_points_each);
    }
    return bytes + floats * sizeof(float);
}

}  // namespace paim
