// Poses of a .paim, as the stage and the bake have them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Decodes an asset that was made from a bake. Vertices are in the order of the bake.
class FilePoses {
  public:
    // Keeps a reference to the asset.
    // Errors: bad input if it was not made from this bake.
    FilePoses(const Asset& asset, const BakeReader& bake);

    // At a time in poses.
    DecodedPose pose(double time, const DecodeLimits& limits = {});

    // The still meshes, decoded; nullptr if there are none.
    const DecodedPose* still() const { return still_ ? &*still_ : nullptr; }

  private:
    MeshDecoder decoder_;
    std::vector<uint32_t> old_vertex_;  // [V] the vertex of the bake for each of the file
    uint32_t num_following_;            // of the bake's vertices
    std::optional<DecodedPose> still_;
    DecodedPose decoded_;  // in the order of the file
};

}  // namespace paim
