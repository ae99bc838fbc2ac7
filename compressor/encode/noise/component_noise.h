// How much of the principal components of a bake's transfer is noise.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "compressor/encode/data/row_source.h"
#include "compressor/encode/svd/principal_components.h"
#include "paim/transfer/layout.h"

namespace paim {

// Energies are sums of squares; l is a band, k a component of all up to the rank, not only of those
// that are kept.
// The noise along a component is measured with the bake's noise matrix, which has the variance of
// the transfer's error and is uncorrelated with it. The symbols are those of
// docs/algorithms/noise.md.
struct ComponentNoise {
    TransferLayout layout;
    uint32_t num_vertices = 0;
    uint32_t num_poses = 0;
    Eigen::MatrixXd energy;             // [bands][K] of X′q_k, ε_lk
    Eigen::MatrixXd noise;              // [bands][K] the noise in it, η_lk
    std::vector<double> vertex_energy;  // [bands][V] of X′ in a vertex's rows of a band, ε_vl
    std::vector<double> vertex_noise;   // [bands][V] the noise in it, η_vl
    double mean_noise = 0.0;            // the noise of the mean over the poses, counted once a pose
    // The components, from the first on, that stand out from noise: s_k² above the noise along it
    // times (1 + √((P − 1) / num_independent()))², the edge of Marchenko and Pastur up to which the
    // spectrum of pure noise spreads.
    uint32_t num_above_noise = 0;

    // Expected noise of component k over all bands.
    double noise_of(Eigen::Index k) const { return noise.col(k).sum(); }
    // s_k² without its noise, at least 0.
    double signal_of(Eigen::Index k) const;

    // ν, how many vertices' worth of noise there is: (Σ η_v)² / Σ η_v². Rays of different vertices
    // are independent. 0 without noise.
    double num_independent() const;
};

// transfer, noise  rows of the bake, plane-major, a column a pose
// num_in_flight    blocks of rows that are worked on at once; at most kMaxMeasuredAtOnce are
ComponentNoise measure_component_noise(const RowSource& transfer, const RowSource& noise,
                                       const TransferLayout& layout,
                                       const PrincipalComponents& components,
                                       uint32_t num_in_flight = kMaxInFlight);

constexpr uint32_t kMaxMeasuredAtOnce = 8;

// Memory of measure_component_noise() for P poses, in addition to the rows at work, of which
// kMaxMeasuredAtOnce blocks are: a copy of V, and energy and noise of each block and of all.
constexpr uint64_t component_noise_scratch_bytes(uint64_t num_poses, uint64_t num_bands,
                                                 uint32_t num_in_flight) {
    const uint64_t blocks = num_in_flight < kMaxMeasuredAtOnce ? num_in_flight : kMaxMeasuredAtOnce;
    return (num_poses + 2 * (blocks + 1) * num_bands) * num_poses * sizeof(double);
}

// Memory that the result holds for each vertex: energy and noise of every band.
constexpr uint64_t component_noise_bytes(uint64_t num_vertices, uint64_t num_bands) {
    return 2 * num_bands * num_vertices * sizeof(double);
}

}  // namespace paim
