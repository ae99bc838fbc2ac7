// Scales each component down by its share of noise.
// Based on: Wiener, Extrapolation, Interpolation, and Smoothing of Stationary Time Series, 1949;
// Efron
//           and Morris, Stein's Estimation Rule and Its Competitors: An Empirical Bayes Approach, 1973
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/encode/noise/component_noise.h"

namespace paim {

// What encoding with shrinkage leaves as error, as energies (sums of squares over rows and poses).
struct EncodedError {
    double truncation = 0.0;  // signal of the components that are dropped
    double noise = 0.0;       // noise that stays, and signal that is lost with the rest
    double total() const { return truncation + noise; }
};

// The same if nothing is shrunk.
EncodedError expected_error_unshrunk(const ComponentNoise& noise, uint32_t num_components);

// Each row of component k is multiplied by signal / (signal + noise), the Wiener factor, which has
// the least mean square error. Both differ much between vertices (open ones have no noise, still
// ones no signal) and bands (high ones have more noise); so their energies are modelled as a
// product of what the vertex has in the band and the share of the component in the band:
//
//     signal(v, l, k) = max(0, ε_vl − η_vl) · φ_lk      φ_lk = max(0, ε_lk − η_lk) / Σ_k max(0, ε_lk − η_lk)
//     noise (v, l, k) = η_vl · ψ_lk                     ψ_lk = η_lk / Σ_v η_vl
//
// ε_vl, η_vl, ε_lk and η_lk are vertex_energy, vertex_noise, energy and noise of ComponentNoise
// (docs/algorithms/noise.md).
class Shrinkage {
  public:
    explicit Shrinkage(const ComponentNoise& noise);

    // The factor of component k at a vertex in a band, 0 … 1; 1 where nothing is noise.
    double factor(uint32_t band, size_t v, uint32_t k) const;

    // Multiplies rows of the components, the first of which is row `first` of the data matrix.
    void apply(uint64_t first, std::vector<std::vector<float>>& components) const;

    // What is expected to be left as error if K components are kept and shrunk.
    EncodedError expected_error(uint32_t num_components) const;

    // Memory that it holds for each vertex: signal and noise of every band.
    static constexpr uint64_t held_bytes(uint64_t num_vertices, uint64_t num_bands) {
        return 2 * num_bands * num_vertices * sizeof(double);
    }

  private:
    // Expected squared error of the first components at a vertex in a band.
    double risk(uint32_t band, size_t v, Eigen::Index num_components) const;

    TransferLayout layout_;
    size_t num_vertices_;
    uint32_t num_poses_;
    Eigen::Index num_above_noise_;
    double mean_noise_;
    std::vector<double> signal_, noise_;  // [bands][V] ε_vl − η_vl, which may be negative, and η_vl
    Eigen::MatrixXd signal_share_, noise_share_;  // [bands][K] φ_lk, ψ_lk
    Eigen::VectorXd component_signal_;  // [K] ε_lk − η_lk over all bands, which may be negative
};

}  // namespace paim
