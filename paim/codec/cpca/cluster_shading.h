// The radiance of vertices from that of their clusters' bases.
//
// Clusters of neighbouring vertices alternate, so that vertices in the order of the mesh would read
// rows of another basis every few vertices. Here the coefficients are copied once, cluster after
// cluster. The rows of a basis then are factors of many vertices, which vector units take at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/vector.h"
#include "paim/codec/cpca/vertex_clusters.h"
#include "paim/codec/vector_unit.h"
#include "paim/mesh/topology.h"

namespace paim {

class ClusterShading {
  public:
    // Copies the coefficients.
    explicit ClusterShading(const VertexClusters& clusters);

    // radiance(v) = albedo(v) · ((b(c, 0) + coefficients[0][v] · b(c, 1)) + coefficients[1][v] · …),
    // c being the vertex's cluster and b(c, i) the radiance of row i of its basis. It equals
    // decoding and shading up to rounding. All units give the same bytes.
    // basis_radiance  [rows] (checked), of CpcaPlayer::basis_radiance()
    // num_components  of clusters, in use
    // radiance        [V] (checked), linear RGB
    void shade(std::span<const Vec3f> basis_radiance, uint32_t num_components, const Albedo& albedo,
               std::span<Vec3f> radiance, VectorUnit unit = best_vector_unit()) const;

  private:
    // Vertices of one cluster: numbers first to first + count − 1 of vertices_.
    struct Piece {
        uint32_t cluster;
        uint32_t first;
        uint32_t count;
    };

    void shade_piece(const Piece& piece, std::span<const Vec3f> basis_radiance,
                     std::span<const StoredValues> coefficients, const Albedo& albedo,
                     std::span<Vec3f> radiance, VectorUnit unit) const;

    uint32_t num_rows_;
    uint32_t rows_per_cluster_;
    std::vector<uint32_t> vertices_;  // [V], by cluster
    std::vector<Piece> pieces_;
    std::vector<StoredValues> coefficients_;  // [components] of [V + padding], by cluster
};

}  // namespace paim
