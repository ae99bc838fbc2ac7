// A compressed animation in memory: what a .paim file holds.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "paim/codec/still_planes.h"
#include "paim/codec/stored_values.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// The most poses that a file may hold: twelve hours at 24 frames a second.
constexpr uint32_t kMaxPoses = 1u << 20;

// Geometry or transfer of an animation: each is compressed on its own.
enum class Attribute { geometry, transfer };

// A data matrix as mean + components · weights (E3, E4): column p is
//   mean + Σ_k weights[k][p] · components[k].
// Rows are plane-major: row = plane · N + n, with a point n for every vertex, or, where vertices share
// bases (VertexClusters), for every row of a basis. Floats: components have unit RMS (|component_k|² =
// rows) before noise is taken out of them, so that half floats hold them well, and weights carry the
// singular value. Integers: values are multiples of their plane's step, and weights have about unit
// RMS, so that one step costs about the same error in every component.
struct LowRankMatrix {
    uint32_t num_points = 0;
    uint32_t num_planes = 0;
    uint32_t num_poses = 0;
    uint32_t num_components = 0;
    Precision precision = Precision::f32;  // of the file; integers may need fewer bits than it says
    std::vector<float> steps;              // [planes], of integers; floats: empty, 1 each
    StoredValues mean;                     // [planes][N], in steps
    std::vector<StoredValues> components;  // [K] of [planes][N], in steps
    std::vector<float> weights;            // [K][P]
    // [K] integers times which the weights of a component are, or none: floats as they are.
    std::vector<float> weight_steps;
    std::vector<double> singular_values;  // [rank of the full matrix], descending, unshrunk
    // [K] which singular value each component has, ascending; none: component k has the k-th. Others
    // are left out where quantisation made one of them nothing but zero.
    std::vector<uint32_t> singular_indices;

    uint32_t singular_index(uint32_t k) const {
        return singular_indices.empty() ? k : singular_indices[k];
    }
    size_t num_rows() const { return size_t{num_planes} * num_points; }
    float step(uint32_t plane) const { return steps.empty() ? 1.0f : steps[plane]; }
};

constexpr uint32_t kMaxClusters = 32767;
constexpr uint32_t kMaxClusterComponents = 255;  // of one cluster

// Clustered PCA: every vertex is a mean and a few components of its cluster, so that light and
// pose can be applied to the bases of the clusters instead of to every vertex.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
struct VertexClusters {
    uint32_t num_clusters = 0;               // 0: vertices have values of their own
    uint32_t num_components = 0;             // of a cluster, beside its mean
    std::vector<uint32_t> cluster;           // [V]
    std::vector<StoredValues> coefficients;  // [components] of [V]
    // [clusters][1 + components] what the rows of a basis are multiplied by. Row 0 is the mean.
    std::vector<float> scales;

    bool empty() const { return num_clusters == 0; }
    uint32_t rows_per_cluster() const { return num_components + 1; }
    uint32_t num_rows() const { return num_clusters * rows_per_cluster(); }
};

// What stands still beside an animation, stored once. It blocks and bounces the animation's light;
// its own transfer is that of the scenery alone, for the animation casts no shadow on it.
struct Scenery {
    Topology topology;  // without vertices: there is no scenery
    Albedo albedo;
    StillPlanes positions;  // [3][S] scene units
    StillPlanes transfer;   // [planes][S], of the animation's layout

    bool empty() const { return topology.num_vertices == 0; }
};

// Whose order vertices and triangles have.
enum class VertexOrder : uint32_t {
    baked = 0,  // the bake's
    cache = 1,  // what cache_order() makes of it (mesh/cache_order.h)
};

struct Model {
    Topology topology;
    Albedo albedo;
    TransferLayout layout;
    LowRankMatrix geometry;  // 3 planes: x, y, z
    LowRankMatrix transfer;  // layout.num_planes() planes
    // None: a point of the transfer is a vertex. Else a row of a basis, and vertex v of cluster c has
    //   t(v) = scales[c][0] · row(c, 0) + Σ_j coefficients[j][v] · scales[c][1 + j] · row(c, 1 + j).
    VertexClusters clusters;
    Scenery scenery;
    // What the geometry is counted from, scene units: adding it, in double, gives scene
    // coordinates. Zero unless the mesh was far from the world's origin; whoever shows one model
    // alone may ignore it.
    Vec3d origin = Vec3d::Zero();
    float frames_per_second = 24.0f;
    VertexOrder vertex_order = VertexOrder::baked;
    bool complete = true;  // false: the file has more components, which were not there yet
    std::string name;
    std::string provenance_json;  // a JSON object: how it was made, for people and paim-info

    uint32_t num_poses() const { return geometry.num_poses; }
    const LowRankMatrix& attribute(Attribute which) const {
        return which == Attribute::geometry ? geometry : transfer;
    }
};

}  // namespace paim
