// The noise of a bake that a decoder lets through.
// Based on: Efron, The Estimation of Prediction Error: Covariance Penalties and Cross-Validation,
//           2004; Candès, Sing-Long and Trzasko, Unbiased Risk Estimates for Singular Value
//           Thresholding and Spectral Estimators, 2013 (docs/metrics.md)
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "paim/codec/point_groups.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/group_axes.h"
#include "paim/metrics/noise_shares.h"
#include "paim/transfer/layout.h"

namespace paim {

// Points that vertices share, of a decoder whose points are not the vertices.
struct DecodedPoints {
    PointGroups groups;
    // The points in a plane of the bake, [N][P]; nothing if the file does not have the plane.
    std::function<std::optional<Eigen::MatrixXf>(uint32_t plane)> decode;
};

// Estimates tr cov(x̂, x − t) by band, in the letters of docs/metrics.md: the noise is projected on
// the tangent space of what the decoder can fit, and multiplied by the share that the decoder keeps of
// the data there. Planes are [V][P], a column a pose. The same bits come out on any number of threads.
// All depends on the light's band power by the point axes of GroupAxes.
class NoiseCovariance {
  public:
    using Plane = Eigen::Ref<const Eigen::MatrixXf>;

    // span    [P][K'] orthonormal directions over the poses that the decoder can follow
    // points  nothing if the points are the vertices
    NoiseCovariance(const TransferLayout& layout, uint32_t num_vertices, const BandPower& spectrum,
                    const Eigen::MatrixXd& span, std::optional<DecodedPoints> points);

    // First all planes that the file has.
    void survey(uint32_t plane, const Plane& baked, const Plane& noise);
    // Then all planes, in the same order.
    void add(uint32_t plane, const Plane& baked, const Plane& noise, const Plane& decoded);

    // [bands]
    std::vector<double> result() const;

    // Memory that it holds, with what add() takes. survey() takes more, but no more than planes of
    // decoded values, which are not there yet.
    // num_points, num_points_each  of shared points, N and R; 0 if the points are the vertices
    static uint64_t bytes(uint64_t num_vertices, uint64_t span_size, uint64_t num_points,
                          uint64_t num_points_each);

  private:
    using MatrixXf = Eigen::MatrixXf;

    // [K'][V] of a plane [V][P]
    void find_along_span(const Plane& values, MatrixXf& along) const;
    // [K'][N]
    std::optional<MatrixXf> points_along_span(uint32_t plane) const;
    // [K'][rows] of [K'][V]
    MatrixXf rows_of(const MatrixXf& vertices) const;
    void survey_points(const MatrixXf& points, double weight);
    void finish_survey();
    void compare_coordinates();
    void add_rows(uint32_t band, const MatrixXf& baked, const MatrixXf& noise,
                  const MatrixXf& decoded);
    void add_coordinates(uint32_t band, const MatrixXf& points);

    TransferLayout layout_;
    BandPower spectrum_;
    MatrixXf span_;  // [P][K']
    std::optional<DecodedPoints> points_;
    std::optional<GroupAxes> axes_;

    bool is_surveyed_ = false;
    MatrixXf baked_along_, noise_along_, decoded_along_;  // [K'][V] of the plane at work

    // A row is a vertex, or the sum of the vertices of a group, weighted by one of their axes.
    // [K'][rows] Sums of squares over all planes, until classes are known.
    Eigen::MatrixXd row_energy_, row_noise_;
    std::vector<uint8_t> row_class_;       // [rows][K']
    std::vector<NoiseShares> row_shares_;  // [bands]

    // Of shared points. Vertices are in the order of GroupAxes.
    MatrixXf baked_coordinates_, noise_coordinates_;  // [R'][V] along the axes of the points
    std::vector<uint8_t> axis_class_;                 // [G][R']
    std::vector<NoiseShares> axis_shares_;            // [bands]
};

}  // namespace paim
