// How much of the principal components of a bake's transfer is noise.
// Based on: Marchenko and Pastur, Distribution of Eigenvalues for Some Sets of Random Matrices,
// 1967;
//           Gavish and Donoho, The Optimal Hard Threshold for Singular Values Is 4/√3, 2014
#include "compressor/encode/noise/component_noise.h"

#include <algorithm>
#include <cmath>

#include "compressor/encode/svd/tsqr.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

// Of one block of rows.
struct BlockEnergies {
    MatrixXd energy, noise;          // [bands][K]
    std::vector<double> row_energy;  // [rows]
    std::vector<double> row_noise;   // [rows]
    double mean_noise = 0.0;
};

uint32_t count_above_noise(const ComponentNoise& measured, uint32_t num_poses) {
    const double independent = measured.num_independent();
    const double spread = independent > 0.0 ? 1.0 + std::sqrt((num_poses - 1) / independent) : 1.0;
    Index k = 0;
    while (k < measured.energy.cols() &&
           measured.energy.col(k).sum() > spread * spread * measured.noise_of(k)) {
        ++k;
    }
    return static_cast<uint32_t>(k);
}

class Measurement {
  public:
    Measurement(const RowSource& transfer, const RowSource& noise, const TransferLayout& layout,
                const PrincipalComponents& components)
        : transfer_(transfer),
          noise_(noise),
          layout_(layout),
          v_(components.v.leftCols(components.rank())) {}

    BlockEnergies measure(uint64_t first, uint64_t count) const {
        BlockEnergies block;
        block.energy = MatrixXd::Zero(static_cast<Index>(layout_.in_bands), v_.cols());
        block.noise = block.energy;
        MatrixXf values(static_cast<Index>(count), v_.rows());
        transfer_.read(first, values);
        project(first, values, block.energy, block.row_energy);
        noise_.read(first, values);
        block.mean_noise = project(first, values, block.noise, block.row_noise);
        return block;
    }

    uint64_t num_vertices() const { return transfer_.num_rows() / layout_.num_planes(); }
    Index band_of_row(uint64_t row) const {
        return layout_.input_band(static_cast<uint32_t>(row / num_vertices()));
    }

  private:
    // Adds squared factors by band, appends squared rows; returns the energy of the mean, once a
    // column.
    double project(uint64_t first, const MatrixXf& values, MatrixXd& by_band,
                   std::vector<double>& by_row) const {
        double mean_energy = 0.0;
        MatrixXd centred, factors;
        Eigen::VectorXd mean;
        for (Index row = 0; row < values.rows();) {
            // Rows of one plane, which are of one band.
            const uint64_t at = first + static_cast<uint64_t>(row);
            const auto left_in_plane = static_cast<Index>(num_vertices() - at % num_vertices());
            const Index size = std::min({kRowsAtOnce, values.rows() - row, left_in_plane});
            centre_rows(values.middleRows(row, size), centred, mean);
            factors.noalias() = centred * v_;
            by_band.row(band_of_row(at)) += factors.colwise().squaredNorm();
            const Eigen::VectorXd energy = centred.rowwise().squaredNorm();
            by_row.insert(by_row.end(), energy.begin(), energy.end());
            mean_energy += mean.squaredNorm();
            row += size;
        }
        return mean_energy * static_cast<double>(values.cols());
    }

    const RowSource& transfer_;
    const RowSource& noise_;
    const TransferLayout& layout_;
    const MatrixXd v_;  // [P][K]
};

}  // namespace

double ComponentNoise::signal_of(Index k) const {
    return std::max(0.0, energy.col(k).sum() - noise_of(k));
}

double ComponentNoise::num_independent() const {
    double sum = 0.0;
    double squares = 0.0;
    for (size_t v = 0; v < num_vertices; ++v) {
        double of_vertex = 0.0;
        for (size_t l = 0; l < layout.in_bands; ++l)
            of_vertex += vertex_noise[l * num_vertices + v];
        sum += of_vertex;
        squares += of_vertex * of_vertex;
    }
    return squares > 0.0 ? sum * sum / squares : 0.0;
}

ComponentNoise measure_component_noise(const RowSource& transfer, const RowSource& noise,
                                       const TransferLayout& layout,
                                       const PrincipalComponents& components,
                                       uint32_t num_in_flight) {
    PAIM_CHECK_EQ(transfer.num_rows(), noise.num_rows());
    PAIM_CHECK_EQ(transfer.num_columns(), noise.num_columns());
    PAIM_CHECK_EQ(transfer.num_rows() % layout.num_planes(), 0u);
    const Measurement measurement(transfer, noise, layout, components);
    ComponentNoise result;
    result.layout = layout;
    result.num_poses = transfer.num_columns();
    result.num_vertices = static_cast<uint32_t>(measurement.num_vertices());
    result.energy = MatrixXd::Zero(static_cast<Index>(layout.in_bands), components.rank());
    result.noise = result.energy;
    result.vertex_energy.resize(size_t{layout.in_bands} * result.num_vertices, 0.0);
    result.vertex_noise.resize(result.vertex_energy.size(), 0.0);

    const uint64_t block_rows = rows_per_block(transfer.num_columns());
    const uint64_t num_blocks = (transfer.num_rows() + block_rows - 1) / block_rows;
    const uint64_t at_once = std::min(num_in_flight, kMaxMeasuredAtOnce);
    for (uint64_t round = 0; round < num_blocks; round += at_once) {
        std::vector<BlockEnergies> blocks(std::min(at_once, num_blocks - round));
        parallel_for(blocks.size(), 1, [&](size_t j, size_t) {
            const uint64_t first = (round + j) * block_rows;
            blocks[j] =
                measurement.measure(first, std::min(block_rows, transfer.num_rows() - first));
        });
        uint64_t row = round * block_rows;
        for (const BlockEnergies& block : blocks) {
            result.energy += block.energy;
            result.noise += block.noise;
            result.mean_noise += block.mean_noise;
            for (size_t r = 0; r < block.row_energy.size(); ++r, ++row) {
                const auto l = static_cast<size_t>(measurement.band_of_row(row));
                const size_t at = l * result.num_vertices + row % result.num_vertices;
                result.vertex_energy[at] += block.row_energy[r];
                result.vertex_noise[at] += block.row_noise[r];
            }
        }
    }
    result.num_above_noise = count_above_noise(result, transfer.num_columns());
    return result;
}

}  // namespace paim
