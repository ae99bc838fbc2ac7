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
// The noise along a component is measured with the bake's noise matrix, which has the variance of the
// transfer's error but is independent of it, and so of the components.
struct ComponentNoise {
    TransferLayout layout;
    uint32_t num_vertices = 0;
    uint32_t num_poses = 0;
    Eigen::MatrixXd energy;             // [bands][K] of the factors A'V
    Eigen::MatrixXd noise;              // [bands][K] of which is noise
    std::vector<double> vertex_energy;  // [bands][V] of A' over a vertex's rows in a band
    std::vector<double> vertex_noise;   // [bands][V] of which is noise
    double mean_noise = 0.0;            // the noise of the mean over the poses, counted once a pose
    // The components, from the first on, that stand out from noise: s_k² above the noise along it times
    // (1 + √((P − 1) / num_independent()))², the edge of Marchenko and Pastur up to which the spectrum
    // of pure noise spreads.
    uint32_t num_above_noise = 0;

    // Expected noise of component k over all bands.
    double noise_of(Eigen::Index k) const { return noise.col(k).sum(); }
    // s_k² without its noise, at least 0.
    double signal_of(Eigen::Index k) const;

    // How many vertices' worth of independent noise there is: (Σ n_v)² / Σ n_v², since rays of different
    // vertices are independent. 0 without noise.
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
