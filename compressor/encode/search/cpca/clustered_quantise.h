// Clustered PCA of an animation's transfer, quantised. A player lights the bases of
// a cluster, and then combines the results with the coefficients of each vertex.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003; Sattler, Sarlette and Klein, Simple and Efficient Compression of
//           Animation Sequences, 2005
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/encode/cluster/clustered_pca.h"
#include "compressor/encode/quantise/quantise.h"
#include "compressor/encode/quantise/scaled_factors.h"
#include "paim/codec/cpca/vertex_clusters.h"

namespace paim {

// A vertex as a point: the factors of all its coefficients, the mean's included. Since the weights
// of the factors are orthogonal and of unit RMS, distances are those of the transfer over all
// poses, divided by √P.
class FactorPoints : public PointSource {
  public:
    // plane_weight  of squared errors; points are scaled by its root
    FactorPoints(const ScaledFactors& factors, const std::vector<double>& plane_weight)
        : factors_(factors), plane_weight_(plane_weight) {}

    uint32_t num_points() const override { return factors_.num_points; }
    uint32_t num_planes() const override { return factors_.num_planes; }
    uint32_t num_columns() const override { return factors_.num_components() + 1; }
    void read(uint32_t plane, Eigen::Ref<Eigen::MatrixXf> out) const override;

  private:
    const ScaledFactors& factors_;
    const std::vector<double>& plane_weight_;
};

// Clusters with a certain number of components, before they are quantised.
struct ClusteredFactors {
    const ClusteredPca* pca = nullptr;
    uint32_t num_components = 0;
    // The rows of all bases, each times √(points of its cluster): an error of a value then costs as
    // much over all vertices as one of the same size anywhere else.
    ScaledFactors bases;
    Eigen::MatrixXd norms;   // [clusters][components] of the rows, weighted, not times that root
    double truncated = 0.0;  // weighted squares that clusters and components leave, over all poses

    uint64_t size_bytes() const {
        return (bases.components.size() + 1) * bases.mean.size() * sizeof(float) +
               static_cast<uint64_t>(norms.size()) * sizeof(double);
    }
};

ClusteredFactors cluster_bases(const ScaledFactors& factors,
                               const std::vector<double>& plane_weight, const ClusteredPca& pca,
                               uint32_t num_components);

struct ClusteredMatrix {
    LowRank matrix;  // of the bases
    VertexClusters clusters;
};

// Bases are quantised as everything is; coefficients of vertices with the step that costs as much
// error as the bases' does.
ClusteredMatrix quantise_clusters(const ClusteredFactors& clustered, const Quantiser& quantiser);

// Weighted squared error against the factors, over all vertices and poses.
double clustered_error(const ClusteredFactors& clustered, const Quantiser& quantiser);

// The smallest step with which bases and coefficients fit in 16 bits.
double smallest_step(const ClusteredFactors& clustered, const Quantiser& quantiser);

// As largest_step() of factors: 0 if clusters and components alone leave more.
double largest_step(const ClusteredFactors& clustered, Quantiser quantiser, double most);

}  // namespace paim
