// How a BRDF spreads light over the sphere of outgoing directions, in spherical harmonics.
// Based on: Sloan, Kautz and Snyder 2002; Kautz, Sloan and Snyder 2002 (see the header)
#include "compressor/material/exit_functions.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/sh/index.h"

namespace paim {

namespace {

constexpr size_t kNodes = size_t{ExitFunctions::kCells} + 1;
constexpr size_t kRegister = 4;  // floats
constexpr size_t kNodesPerPiece = 16;
// BRDFs have no value at the horizon itself.
constexpr double kLowestCosine = 1e-9;

}  // namespace

ExitFunctions::ExitFunctions(const Brdf& brdf, int out_bands) : out_bands_(out_bands) {
    PAIM_CHECK_LE(1, out_bands);
    PAIM_CHECK_LE(out_bands, kMaxBands);
    for (int l = 0; l < out_bands; ++l) {
        for (int m = l % 2; m <= l; m += 2) {
            entries_.push_back({l, m});
            coefficients_.push_back(sh::index(l, m));
            if (m > 0) coefficients_.push_back(sh::index(l, -m));
        }
    }
    stride_ = (entries_.size() + kRegister - 1) / kRegister * kRegister;
    table_.resize(kNodes * stride_);
    albedo_.resize(kNodes);
    const LobeQuadrature quadrature(brdf);
    const sh::BatchBasis basis(out_bands);
    parallel_for(kNodes, kNodesPerPiece, [&](size_t begin, size_t end) {
        std::vector<LobeQuadrature::Point> points;
        for (size_t node = begin; node < end; ++node) {
            const double cosine = cosine_of(static_cast<double>(node) / kCells);
            quadrature.points(std::max(cosine, kLowestCosine), points);
            fill_node(basis, points, node);
        }
    });
}

void ExitFunctions::fill_node(const sh::BatchBasis& basis,
                              const std::vector<LobeQuadrature::Point>& points, size_t node) {
    constexpr size_t kLanes = sh::BatchBasis::kSumLanes;
    const auto num_coefficients = static_cast<size_t>(sh::num_coefficients(out_bands_));
    std::vector<float> sums(num_coefficients * kLanes, 0.0f);
    double albedo = 0.0;
    for (size_t first = 0; first < points.size(); first += kBatch) {
        float x[kBatch]{}, y[kBatch]{}, z[kBatch]{}, weights[kBatch]{};
        for (size_t j = 0; j < std::min<size_t>(kBatch, points.size() - first); ++j) {
            const auto& [v, value, weight] = points[first + j];
            x[j] = static_cast<float>(v.x());
            y[j] = static_cast<float>(v.y());
            z[j] = static_cast<float>(v.z());
            weights[j] = static_cast<float>(2.0 * value * weight);
            albedo += value * weight * v.z();
        }
        basis.accumulate(x, y, z, weights, sums.data());
    }
    for (size_t e = 0; e < entries_.size(); ++e) {
        const auto i = static_cast<size_t>(sh::index(entries_[e].l, entries_[e].m));
        for (size_t lane = 0; lane < kLanes; ++lane) {
            table_[node * stride_ + e] += sums[i * kLanes + lane];
        }
    }
    albedo_[node] = static_cast<float>(albedo);
}

void ExitFunctions::evaluate(const float* x, const float* y, const float* z, float* values) const {
    float coordinate[kBatch], cosine[kMaxBands][kBatch], sine[kMaxBands][kBatch];
    for (int j = 0; j < kBatch; ++j) {
        const float radius2 = x[j] * x[j] + y[j] * y[j];
        const float height = std::max(z[j], 0.0f);
        // √(1 − √height), without the rounding of 1 − height near the normal.
        const float coordinate2 = radius2 / ((1.0f + height) * (1.0f + std::sqrt(height)));
        coordinate[j] = std::sqrt(std::min(coordinate2, 1.0f));
        const float scale = 1.0f / std::sqrt(std::max(radius2, 1e-30f));
        cosine[0][j] = 1.0f;
        sine[0][j] = 0.0f;
        cosine[1][j] = x[j] * scale;
        sine[1][j] = y[j] * scale;
    }
    for (int m = 2; m < out_bands_; ++m) {
        for (int j = 0; j < kBatch; ++j) {
            cosine[m][j] = cosine[1][j] * cosine[m - 1][j] - sine[1][j] * sine[m - 1][j];
            sine[m][j] = sine[1][j] * cosine[m - 1][j] + cosine[1][j] * sine[m - 1][j];
        }
    }
    float entries[kMaxEntries][kBatch];
    look_up(coordinate, entries);
    for (size_t e = 0; e < entries_.size(); ++e) {
        const int m = entries_[e].m;
        for (int j = 0; j < kBatch; ++j) *values++ = entries[e][j] * cosine[m][j];
        if (m == 0) continue;
        for (int j = 0; j < kBatch; ++j) *values++ = entries[e][j] * sine[m][j];
    }
}

void ExitFunctions::look_up(const float* coordinate, float (*entries)[kBatch]) const {
    for (int j = 0; j < kBatch; ++j) {
        const float place = coordinate[j] * static_cast<float>(kCells);
        const int node = std::min(static_cast<int>(place), kCells - 1);
        const float share = place - static_cast<float>(node);
        const float* const first = table_.data() + static_cast<size_t>(node) * stride_;
        for (size_t e = 0; e < stride_; ++e) {
            entries[e][j] = first[e] + share * (first[stride_ + e] - first[e]);
        }
    }
}

double ExitFunctions::interpolate(const std::vector<float>& table, size_t stride, size_t column,
                                  double cosine) const {
    const double place = std::sqrt(std::max(0.0, 1.0 - std::sqrt(cosine))) * kCells;
    const auto node = std::min(static_cast<size_t>(place), size_t{kCells} - 1);
    const double share = place - static_cast<double>(node);
    const double first = table[node * stride + column];
    return first + share * (static_cast<double>(table[(node + 1) * stride + column]) - first);
}

double ExitFunctions::at(int l, int abs_m, double cosine) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const Entry& e) { return e.l == l && e.m == abs_m; });
    PAIM_CHECK(found != entries_.end());
    return interpolate(table_, stride_, static_cast<size_t>(found - entries_.begin()), cosine);
}

double ExitFunctions::albedo(double cosine) const {
    return interpolate(albedo_, 1, 0, cosine);
}

}  // namespace paim
