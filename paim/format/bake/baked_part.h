// One part of a bake, moving or still, with one interface for both.
#pragma once

#include <cstddef>
#include <cstdint>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/outliers.h"

namespace paim {

class BakedPart {
  public:
    // Keeps a reference to the bake.
    // number  0: the moving part; 1: the still part, which must exist (checked)
    BakedPart(const BakeReader& bake, size_t number);

    const Topology& topology() const;
    const Albedo& albedo() const;
    const Texture& texture() const;
    const RootMotion& root_motion() const;  // empty: none
    uint32_t num_following() const;         // of the vertices, from the first; kAllVertices: all
    uint32_t num_vertices() const { return topology().num_vertices; }
    uint32_t num_poses() const { return still_ == nullptr ? bake_.num_poses() : 1; }

    // Rows [first, first + count) of positions or normals (3 · V rows), transfer or noise (planes · V
    // rows) of pose p. May be called from several threads.
    void read_position_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;
    void read_normal_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;
    void read_transfer_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;
    void read_noise_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;

  private:
    const BakeReader& bake_;
    const BakedStillMesh* still_;  // nullptr: the moving part
};

// Outliers of the vertices that a face has (mesh/outliers.h). Reads the positions once, or twice if
// there are any outliers.
PositionOutliers find_outliers(const BakedPart& part);

// 1, or 2 with still meshes.
inline size_t num_baked_parts(const BakeReader& bake) {
    return bake.still_mesh() ? 2 : 1;
}

}  // namespace paim
