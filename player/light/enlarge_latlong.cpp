// Four rows of four pixels for each pixel of the result.
#include "player/light/enlarge_latlong.h"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim::player {

namespace {

constexpr int kNewtonSteps = 10;

// The pixels about a place, of which the first may lie before the map and the last behind it.
struct Support {
    int first;
    std::array<double, 4> weights;
};

// place  in pixels, 0 the centre of the first
Support support_at(double place) {
    const double floor = std::floor(place);
    const double t = place - floor, s = 1.0 - t;
    return {static_cast<int>(floor) - 1,
            {s * s * s / 6.0, (4.0 + 3.0 * t * t * (t - 2.0)) / 6.0,
             (4.0 + 3.0 * s * s * (s - 2.0)) / 6.0, t * t * t / 6.0}};
}

int wrap(int x, int size) {
    const int rest = x % size;
    return rest < 0 ? rest + size : rest;
}

// The row of the map that is j rows below the first along a meridian and back on the opposite one.
struct Row {
    int row;
    bool opposite;
};

Row row_along(int j, int height) {
    const int along = wrap(j, 2 * height);  // rows repeat after twice the height
    const bool opposite = along >= height;
    return {opposite ? 2 * height - 1 - along : along, opposite};
}

Eigen::VectorXd row_areas(int height) {
    Eigen::VectorXd areas(height);
    for (int y = 0; y < height; ++y) {
        areas[y] = std::cos(kPi * y / height) - std::cos(kPi * (y + 1) / height);
    }
    return areas;
}

// Factors of the rows of a map, such that Σ_i area_i share_ij, with share_ij = spline_ij factor_j /
// Σ_k spline_ik factor_k, is the area of row j. The logarithms of the factors minimise a convex
// function, whose Hessian is that of the shares. It does not change when all factors grow alike.
// splines  [rows of the result][rows of the map]
Eigen::VectorXd row_factors(const Eigen::MatrixXd& splines) {
    const Eigen::VectorXd areas = row_areas(static_cast<int>(splines.rows()));
    const Eigen::VectorXd wanted = row_areas(static_cast<int>(splines.cols()));
    Eigen::VectorXd factors = Eigen::VectorXd::Ones(splines.cols());
    for (int step = 0; step < kNewtonSteps; ++step) {
        const Eigen::VectorXd totals = splines * factors;
        const Eigen::MatrixXd shares =
            totals.cwiseInverse().asDiagonal() * splines * factors.asDiagonal();
        const Eigen::VectorXd is = shares.transpose() * areas;
        Eigen::MatrixXd hessian = -(shares.transpose() * areas.asDiagonal() * shares);
        hessian.diagonal() += is;
        hessian.array() +=
            1.0 / static_cast<double>(splines.cols());  // for factors that grow alike
        const Eigen::VectorXd change = hessian.ldlt().solve(wanted - is);
        factors.array() *= change.array().exp();
    }
    return factors;
}

// Supports of the rows of the result, with weights that sum to 1.
std::vector<Support> row_supports(int from_height, int to_height) {
    std::vector<Support> supports;
    Eigen::MatrixXd splines = Eigen::MatrixXd::Zero(to_height, from_height);
    for (int y = 0; y < to_height; ++y) {
        supports.push_back(support_at((y + 0.5) * from_height / to_height - 0.5));
        for (int j = 0; j < 4; ++j) {
            const int row = row_along(supports.back().first + j, from_height).row;
            splines(y, row) += supports.back().weights[static_cast<size_t>(j)];
        }
    }
    const Eigen::VectorXd factors = row_factors(splines);
    const Eigen::VectorXd totals = splines * factors;
    for (int y = 0; y < to_height; ++y) {
        Support& rows = supports[static_cast<size_t>(y)];
        for (int j = 0; j < 4; ++j) {
            rows.weights[static_cast<size_t>(j)] *=
                factors[row_along(rows.first + j, from_height).row] / totals[y];
        }
    }
    return supports;
}

Vec3f row_value(const Image& map, const Support& columns, int row) {
    Vec3f sum = Vec3f::Zero();
    for (int i = 0; i < 4; ++i) {
        sum += static_cast<float>(columns.weights[static_cast<size_t>(i)]) *
               map.at(wrap(columns.first + i, map.width), row);
    }
    return sum;
}

// A column of the result: its place in the map, and the place half a turn away.
struct Columns {
    Support here, opposite;
};

Vec3f value_at(const Image& map, const Columns& columns, const Support& rows) {
    Vec3f sum = Vec3f::Zero();
    for (int j = 0; j < 4; ++j) {
        const Row row = row_along(rows.first + j, map.height);
        sum += static_cast<float>(rows.weights[static_cast<size_t>(j)]) *
               row_value(map, row.opposite ? columns.opposite : columns.here, row.row);
    }
    return sum;
}

}  // namespace

Image enlarge_latlong(const Image& map, int width, int height) {
    PAIM_CHECK_LE(1, map.width);
    PAIM_CHECK_LE(1, map.height);
    PAIM_CHECK_LE(map.width, width);
    PAIM_CHECK_LE(map.height, height);
    std::vector<Columns> columns;
    for (int x = 0; x < width; ++x) {
        const double place = (x + 0.5) * map.width / width - 0.5;
        columns.push_back({support_at(place), support_at(place + 0.5 * map.width)});
    }
    const std::vector<Support> rows = row_supports(map.height, height);
    Image result(width, height);
    parallel_for(static_cast<size_t>(height), 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                result.at(x, static_cast<int>(y)) =
                    value_at(map, columns[static_cast<size_t>(x)], rows[y]);
            }
        }
    });
    return result;
}

}  // namespace paim::player
