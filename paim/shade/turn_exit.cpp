// Outgoing radiance of vertices, turned from their frames to the axes of the pose.
#include "paim/shade/turn_exit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

namespace {

constexpr size_t kLanes = sh::BatchBasis::kBatch;
constexpr size_t kBatchesATask = 16;

// Directions on a spiral over the upper half of the sphere, and for each band the matrix that makes
// coefficients of values in them. The lower half has the same values up to their sign.
struct Directions {
    explicit Directions(int bands) {
        const int count = 3 * bands;
        const double turn = kPi * (3.0 - std::sqrt(5.0));
        for (int j = 0; j < count; ++j) {
            const double z = 1.0 - (j + 0.5) / count;
            const double radius = std::sqrt(1.0 - z * z);
            points.push_back({radius * std::cos(j * turn), radius * std::sin(j * turn), z});
        }
        std::vector<double> values(static_cast<size_t>(sh::num_coefficients(bands)));
        for (int l = 0; l < bands; ++l) {
            Eigen::MatrixXd basis(count, 2 * l + 1);
            for (int j = 0; j < count; ++j) {
                sh::evaluate_basis(bands, points[static_cast<size_t>(j)], std::span(values));
                for (int i = 0; i < 2 * l + 1; ++i) {
                    basis(j, i) = values[static_cast<size_t>(l * l + i)];
                }
            }
            const Eigen::MatrixXd square = basis.transpose() * basis;
            from_values.push_back(square.ldlt().solve(basis.transpose()).cast<float>());
        }
    }

    std::vector<Vec3d> points;
    std::vector<Eigen::MatrixXf> from_values;  // of each band, [2l + 1][points]
};

const Directions& directions_of(int bands) {
    static const std::vector<Directions> all = [] {
        std::vector<Directions> made;
        for (uint32_t b = 1; b <= kMaxOutBands; ++b) made.emplace_back(static_cast<int>(b));
        return made;
    }();
    return all[static_cast<size_t>(bands) - 1];
}

// Sixteen rows at a time. Each thread needs its own.
class RowTurner {
  public:
    RowTurner(int bands, std::span<const Eigen::Matrix3f> frames, std::span<const Vec3f> exit,
              std::span<Vec3f> turned)
        : bands_(bands),
          directions_(directions_of(bands)),
          basis_(bands),
          frames_(frames),
          exit_(exit),
          turned_(turned),
          values_(static_cast<size_t>(sh::num_coefficients(bands)) * kLanes) {}

    void turn(size_t first) {
        const size_t count = std::min(kLanes, frames_.size() - first);
        for (int o = 0; o < sh::num_coefficients(bands_); ++o) {
            std::fill_n(&turned_[at(o, first)], count, Vec3f(Vec3f::Zero()));
        }
        for (size_t j = 0; j < directions_.points.size(); ++j) {
            evaluate(directions_.points[j].cast<float>(), first, count);
            for (int l = 0; l < bands_; ++l) add_band(l, j, first, count);
        }
    }

  private:
    size_t at(int coefficient, size_t row) const {
        return static_cast<size_t>(coefficient) * frames_.size() + row;
    }

    // The basis in the frames of the rows.
    void evaluate(const Vec3f& direction, size_t first, size_t count) {
        float x[kLanes] = {}, y[kLanes] = {}, z[kLanes] = {};
        for (size_t lane = 0; lane < count; ++lane) {
            const Vec3f local = frames_[first + lane].transpose() * direction;
            x[lane] = local.x();
            y[lane] = local.y();
            z[lane] = local.z();
        }
        basis_.evaluate(x, y, z, values_.data());
    }

    void add_band(int l, size_t j, size_t first, size_t count) {
        Vec3f sums[kLanes];
        std::fill_n(sums, kLanes, Vec3f(Vec3f::Zero()));
        for (int k = sh::num_even_coefficients(l); k < sh::num_even_coefficients(l + 1); ++k) {
            const float* const y =
                values_.data() + static_cast<size_t>(sh::even_coefficient(k)) * kLanes;
            const Vec3f* const from = &exit_[at(k, first)];
            for (size_t lane = 0; lane < count; ++lane) sums[lane] += y[lane] * from[lane];
        }
        const Eigen::MatrixXf& matrix = directions_.from_values[static_cast<size_t>(l)];
        for (int i = 0; i < 2 * l + 1; ++i) {
            const float factor = matrix(i, static_cast<Eigen::Index>(j));
            Vec3f* const to = &turned_[at(l * l + i, first)];
            for (size_t lane = 0; lane < count; ++lane) to[lane] += factor * sums[lane];
        }
    }

    const int bands_;
    const Directions& directions_;
    const sh::BatchBasis basis_;
    std::span<const Eigen::Matrix3f> frames_;
    std::span<const Vec3f> exit_;
    std::span<Vec3f> turned_;
    std::vector<float> values_;
};

}  // namespace

void turn_exit(int out_bands, std::span<const Eigen::Matrix3f> frames, std::span<const Vec3f> exit,
               std::span<Vec3f> turned) {
    const size_t num_rows = frames.size();
    PAIM_CHECK_EQ(exit.size(),
                  static_cast<size_t>(sh::num_even_coefficients(out_bands)) * num_rows);
    PAIM_CHECK_EQ(turned.size(), static_cast<size_t>(sh::num_coefficients(out_bands)) * num_rows);
    parallel_for((num_rows + kLanes - 1) / kLanes, kBatchesATask, [&](size_t begin, size_t end) {
        RowTurner turner(out_bands, frames, exit, turned);
        for (size_t batch = begin; batch < end; ++batch) turner.turn(batch * kLanes);
    });
}

}  // namespace paim
