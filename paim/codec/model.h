// A compressed animation in memory: what a .paim file holds.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// The most poses that a file may hold: twelve hours at 24 frames a second.
constexpr uint32_t kMaxPoses = 1u << 20;

// How components are stored in the file; means and weights are always f32.
enum class Precision : uint32_t { f32 = 0, f16 = 1 };

// A data matrix as mean + components · weights (E3, E4): column p is
//   mean + Σ_k weights[k][p] · components[k].
// Rows are plane-major: row = plane · V + v. Components have unit RMS (|component_k|² = rows) before
// noise is taken out of them, so that half floats hold them well; weights carry the singular value.
struct LowRankMatrix {
    uint32_t num_vertices = 0;
    uint32_t num_planes = 0;
    uint32_t num_poses = 0;
    uint32_t num_components = 0;
    Precision precision = Precision::f32;
    std::vector<float> mean;              // [planes][V]
    std::vector<float> components;        // [K][planes][V]
    std::vector<float> weights;           // [K][P]
    std::vector<double> singular_values;  // [rank of the full matrix], descending, unshrunk

    size_t num_rows() const { return size_t{num_planes} * num_vertices; }
    std::span<const float> component(uint32_t k) const {
        return std::span(components).subspan(k * num_rows(), num_rows());
    }
};

// What stands still beside an animation, stored once. It blocks and bounces the animation's light;
// its own transfer is that of the scenery alone, for the animation casts no shadow on it.
struct Scenery {
    Topology topology;  // without vertices: there is no scenery
    Albedo albedo;
    std::vector<float> positions;  // [3][S] scene units
    std::vector<float> transfer;   // [planes][S], of the animation's layout

    bool empty() const { return topology.num_vertices == 0; }
};

struct Model {
    Topology topology;
    Albedo albedo;
    TransferLayout layout;
    LowRankMatrix geometry;  // 3 planes: x, y, z
    LowRankMatrix transfer;  // layout.num_planes() planes
    Scenery scenery;
    // What the geometry is counted from, scene units: adding it, in double, gives scene
    // coordinates. Zero unless the mesh was far from the world's origin; whoever shows one model
    // alone may ignore it.
    Vec3d origin = Vec3d::Zero();
    float frames_per_second = 24.0f;
    std::string name;
    std::string provenance_json;  // a JSON object: how it was made, for people and paim-info

    uint32_t num_poses() const { return geometry.num_poses; }
};

}  // namespace paim
