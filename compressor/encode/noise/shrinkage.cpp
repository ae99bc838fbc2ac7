// Scales each component down by its share of noise.
// Based on: Wiener 1949; Efron and Morris 1973 (see the header)
#include "compressor/encode/noise/shrinkage.h"

#include <algorithm>
#include <numeric>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;

EncodedError expected_error_unshrunk(const ComponentNoise& noise, uint32_t num_components) {
    PAIM_CHECK_LE(num_components, static_cast<uint64_t>(noise.energy.cols()));
    const Index dropped = noise.energy.cols() - static_cast<Index>(num_components);
    const double left = (noise.energy - noise.noise).rightCols(dropped).sum();
    return {std::max(0.0, left),
            noise.mean_noise + noise.noise.leftCols(static_cast<Index>(num_components)).sum()};
}

Shrinkage::Shrinkage(const ComponentNoise& noise)
    : layout_(noise.layout),
      num_vertices_(noise.num_vertices),
      num_poses_(noise.num_poses),
      num_above_noise_(static_cast<Index>(noise.num_above_noise)),
      mean_noise_(noise.mean_noise),
      signal_(noise.vertex_energy),
      noise_(noise.vertex_noise),
      signal_share_((noise.energy - noise.noise).cwiseMax(0.0)),
      noise_share_(noise.noise),
      component_signal_((noise.energy - noise.noise).colwise().sum()) {
    for (size_t j = 0; j < signal_.size(); ++j) signal_[j] -= noise_[j];
    for (Index l = 0; l < signal_share_.rows(); ++l) {
        const double signal = signal_share_.row(l).sum();
        if (signal > 0.0) signal_share_.row(l) /= signal;
        const auto first = noise_.begin() + l * static_cast<Index>(num_vertices_);
        const double all = std::accumulate(first, first + static_cast<Index>(num_vertices_), 0.0);
        if (all > 0.0) noise_share_.row(l) /= all;
    }
}

double Shrinkage::factor(uint32_t band, size_t v, uint32_t k) const {
    const auto l = static_cast<Index>(band);
    const double noise = noise_[band * num_vertices_ + v] * noise_share_(l, k);
    if (noise <= 0.0) return 1.0;
    const double signal = std::max(0.0, signal_[band * num_vertices_ + v]) * signal_share_(l, k);
    return signal / (signal + noise);
}

void Shrinkage::apply(uint64_t first, std::vector<std::vector<float>>& components) const {
    PAIM_CHECK_LE(components.size(), static_cast<uint64_t>(signal_share_.cols()));
    parallel_for(components.size(), 1, [&](size_t k, size_t) {
        std::vector<float>& rows = components[k];
        for (size_t r = 0; r < rows.size();) {
            const uint64_t plane = (first + r) / num_vertices_;
            const uint32_t band = layout_.input_band(static_cast<uint32_t>(plane));
            const size_t end = std::min(rows.size(), (plane + 1) * num_vertices_ - first);
            for (; r < end; ++r) {
                const size_t v = (first + r) % num_vertices_;
                rows[r] *= static_cast<float>(factor(band, v, static_cast<uint32_t>(k)));
            }
        }
    });
}

// Stein's unbiased estimate of the squared error of a factor w that depends on the data: with e the
// energy of a component here, n its noise and d the values it has,
//     (1 − w)² e + (2w − 1) n + 4/d (e ∂w/∂e) n − 2 Cov(w, n),
// the last because the noise too is an estimate. With e = signal + n in w that is w n and two
// corrections; where w = 0 as there seems to be less than no signal, e − n.
// Based on: Stein, Estimation of the Mean of a Multivariate Normal Distribution, 1981
double Shrinkage::risk(uint32_t band, size_t v, Index num_components) const {
    const double all_noise = noise_[band * num_vertices_ + v];
    const double all_signal = signal_[band * num_vertices_ + v];
    if (all_noise <= 0.0) return 0.0;
    const auto l = static_cast<Index>(band);
    // Values of which a component has so many at a vertex, and draws of which its noise is the sum.
    const double values = (2.0 * band + 1.0) * layout_.channels;
    const double draws = values * (num_poses_ - 1.0);
    double sum = 0.0;
    for (Index k = 0; k < num_components; ++k) {
        const double share = signal_share_(l, k);
        if (all_signal <= 0.0) {
            // Beyond those that stand out from noise, what is above it elsewhere is not counted
            // either.
            if (k < num_above_noise_) sum += all_signal * noise_share_(l, k);
            continue;
        }
        const double n = all_noise * noise_share_(l, k);
        const double energy = all_signal * share + n;
        if (energy <= 0.0) continue;
        const double w = factor(band, v, static_cast<uint32_t>(k));
        sum += w * n + 4.0 / values * n * n * share / energy +
               4.0 / draws * share * (all_signal + all_noise) * n * n / (energy * energy);
    }
    return sum;
}

EncodedError Shrinkage::expected_error(uint32_t num_components) const {
    const Index kept = static_cast<Index>(num_components);
    PAIM_CHECK_LE(kept, component_signal_.size());
    EncodedError error;
    error.truncation = std::max(0.0, component_signal_.tail(component_signal_.size() - kept).sum());
    error.noise = mean_noise_;
    for (uint32_t l = 0; l < layout_.in_bands; ++l) {
        for (size_t v = 0; v < num_vertices_; ++v) error.noise += risk(l, v, kept);
    }
    error.noise = std::max(0.0, error.noise);
    return error;
}

}  // namespace paim
