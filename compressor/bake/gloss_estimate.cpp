// Estimates of the glossy transfer of a vertex from each half of its rays.
// Based on: Sloan, Kautz and Snyder 2002 (see the header)
#include "compressor/bake/gloss_estimate.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr size_t kPacket = sh::BatchBasis::kBatch;
static_assert(kPacket == ExitFunctions::kBatch);

// A vector register of SSE2 and NEON. GCC and Clang do arithmetic on this type directly.
using LaneFloats = float __attribute__((vector_size(16)));
constexpr size_t kRegisterLanes = 4;

// Lane sums are floats. After this many packets of rays they are added to doubles, before rounding
// matters.
constexpr size_t kGlossPacketsPerFlush = 32;

inline LaneFloats load_lanes(const float* from) {
    LaneFloats lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

// Adds the products of two rows of sixteen values with `count` other rows.
// other  [count][kPacket]
// sums   [count][kRegisterLanes] of each
void add_products(const float* a, const float* b, const float* other, size_t count, float* sums_a,
                  float* sums_b) {
    const LaneFloats a0 = load_lanes(a), a1 = load_lanes(a + 4), a2 = load_lanes(a + 8),
                     a3 = load_lanes(a + 12);
    const LaneFloats b0 = load_lanes(b), b1 = load_lanes(b + 4), b2 = load_lanes(b + 8),
                     b3 = load_lanes(b + 12);
    for (size_t i = 0; i < count; ++i) {
        const float* const row = other + i * kPacket;
        const LaneFloats y0 = load_lanes(row), y1 = load_lanes(row + 4), y2 = load_lanes(row + 8),
                         y3 = load_lanes(row + 12);
        const LaneFloats to_a =
            load_lanes(sums_a + i * kRegisterLanes) + ((a0 * y0 + a1 * y1) + (a2 * y2 + a3 * y3));
        const LaneFloats to_b =
            load_lanes(sums_b + i * kRegisterLanes) + ((b0 * y0 + b1 * y1) + (b2 * y2 + b3 * y3));
        std::memcpy(sums_a + i * kRegisterLanes, &to_a, sizeof to_a);
        std::memcpy(sums_b + i * kRegisterLanes, &to_b, sizeof to_b);
    }
}

}  // namespace

GlossSums::GlossSums(const sh::BatchBasis& basis, const TransferLayout& layout)
    : basis_(basis),
      layout_(layout),
      num_in_(layout.num_coefficients()),
      light_(num_in_ * kPacket) {
    PAIM_CHECK_EQ(basis.bands(), static_cast<int>(layout.in_bands));
}

void GlossSums::start(const GlossReflection& reflection, const VertexFrame& frame) {
    reflection_ = &reflection;
    frame_ = &frame;
    num_points_ = 0.0;
    const auto num_rows = static_cast<size_t>(reflection.functions.num_rows());
    sums_.assign(num_rows * num_in_, 0.0);
    // Rows are added in pairs; the last may be one of zeros.
    const size_t padded_rows = num_rows + num_rows % 2;
    exit_.assign(padded_rows * kPacket, 0.0f);
    lanes_.assign(padded_rows * num_in_ * kRegisterLanes, 0.0f);
}

void GlossSums::add(const RaySet& rays, std::span<const float> factors, double num_points,
                    double weight) {
    num_points_ += weight * num_points;
    size_t num_packets = 0;
    for (size_t first = 0; first < rays.weights.size(); first += kPacket) {
        float weights[kPacket];
        bool any = false;
        for (size_t j = 0; j < kPacket; ++j) {
            weights[j] = rays.weights[first + j] * factors[first + j];
            any = any || weights[j] != 0.0f;
        }
        if (!any) continue;
        add_packet(rays, first, weights);
        if (++num_packets % kGlossPacketsPerFlush == 0) flush(weight);
    }
    flush(weight);
}

void GlossSums::add_packet(const RaySet& rays, size_t first, const float* weights) {
    float x[kPacket], y[kPacket], z[kPacket];
    frame_->directions_to_frame(rays, first, x, y, z);
    reflection_->functions.evaluate(x, y, z, exit_.data());
    const auto num_rows = static_cast<size_t>(reflection_->functions.num_rows());
    for (size_t row = 0; row < num_rows; ++row) {
        for (size_t j = 0; j < kPacket; ++j) exit_[row * kPacket + j] *= weights[j];
    }
    basis_.evaluate(rays.x.data() + first, rays.y.data() + first, rays.z.data() + first,
                    light_.data());
    for (size_t row = 0; row < num_rows; row += 2) {
        float* const sums = lanes_.data() + row * num_in_ * kRegisterLanes;
        add_products(exit_.data() + row * kPacket, exit_.data() + (row + 1) * kPacket,
                     light_.data(), num_in_, sums, sums + num_in_ * kRegisterLanes);
    }
}

void GlossSums::flush(double weight) {
    for (size_t r = 0; r < sums_.size(); ++r) {
        for (size_t lane = 0; lane < kRegisterLanes; ++lane) {
            sums_[r] += weight * static_cast<double>(lanes_[r * kRegisterLanes + lane]);
        }
    }
    std::fill(lanes_.begin(), lanes_.end(), 0.0f);
}

void GlossSums::estimate(double c, std::span<double> estimate) {
    PAIM_CHECK(num_points_ > 0.0);
    PAIM_CHECK_EQ(estimate.size(), layout_.num_outgoing() * num_in_);
    const std::vector<int>& outgoing = reflection_->functions.coefficients();
    std::fill(estimate.begin(), estimate.end(), 0.0);
    for (size_t row = 0; row < outgoing.size(); ++row) {
        const int m = outgoing[row] - sh::index(sh::band_of(outgoing[row]), 0);
        double* const sums = sums_.data() + row * num_in_;
        for (size_t i = 0; i < num_in_; ++i) sums[i] *= kPi / num_points_;
        add_open(reflection_->open.data() + row * num_in_, m, c, sums);
    }
    frame_->rows_to_pose(outgoing, num_in_, sums_.data(), estimate.data());
}

void GlossSums::add_open(const double* open, int m, double c, double* sums) const {
    if (c == 0.0) return;
    for (int l = std::abs(m); l < static_cast<int>(layout_.in_bands); ++l) {
        const Eigen::MatrixXd& block = frame_->to_pose().block(l);
        const double value = c * open[sh::index(l, m)];
        for (int to_m = -l; to_m <= l; ++to_m) {
            sums[sh::index(l, to_m)] += block(l + to_m, l + m) * value;
        }
    }
}

}  // namespace paim
