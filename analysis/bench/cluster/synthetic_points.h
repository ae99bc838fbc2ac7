// Points that are clustered as a transfer's vertices are, of any number and dimension.
#pragma once

#include <cmath>

#include "compressor/encode/data/point_source.h"
#include "paim/base/seed.h"

namespace paim::bench {

// Points on smooth patches: 16 broad directions shared by all, each of 200 patches with 16 of its
// own, amplitudes falling by 0.8 a direction, and noise of a hundredth.
class SyntheticPoints : public PointSource {
  public:
    SyntheticPoints(uint32_t num_points, uint32_t num_planes, uint32_t num_columns)
        : num_points_(num_points), num_planes_(num_planes), num_columns_(num_columns) {
        RandomStream random(stream_key(7, 0, 0));
        coefficients_ =
            Eigen::MatrixXf::NullaryExpr(num_points, kRank, [&] { return draw(random); });
    }

    uint32_t num_points() const override { return num_points_; }
    uint32_t num_planes() const override { return num_planes_; }
    uint32_t num_columns() const override { return num_columns_; }
    void read(uint32_t plane, Eigen::Ref<Eigen::MatrixXf> out) const override {
        RandomStream random(stream_key(7, 1, plane));
        Eigen::MatrixXf basis(kRank * (kPatches + 1), out.cols());
        for (float& x : basis.reshaped()) x = draw(random);
        for (Eigen::Index k = 0; k < basis.rows(); ++k) {
            basis.row(k) *= std::pow(0.8f, static_cast<float>(k % kRank));
        }
        const auto count = static_cast<Eigen::Index>(num_points_);
        for (Eigen::Index p = 0; p < kPatches; ++p) {
            const Eigen::Index first = p * count / kPatches;
            const Eigen::Index size = (p + 1) * count / kPatches - first;
            out.middleRows(first, size) =
                coefficients_.middleRows(first, size) *
                (basis.topRows(kRank) + basis.middleRows(kRank * (p + 1), kRank));
            out.middleRows(first, size).rowwise() += 3.0f * basis.row(kRank * (p + 1));
        }
        for (Eigen::Index c = 0; c < out.cols(); ++c) {
            for (float& x : out.col(c)) x += 0.01f * draw(random);
        }
    }

  private:
    static constexpr Eigen::Index kRank = 16, kPatches = 200;
    static float draw(RandomStream& random) { return static_cast<float>(random.uniform() - 0.5); }

    uint32_t num_points_, num_planes_, num_columns_;
    Eigen::MatrixXf coefficients_;
};

}  // namespace paim::bench
