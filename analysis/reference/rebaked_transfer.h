// The transfer of a bake's poses, baked again with other options.
#pragma once

#include <optional>
#include <vector>

#include "compressor/bake/transfer_baker.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

class RebakedTransfer {
  public:
    // Keeps a reference to the bake.
    RebakedTransfer(const BakeReader& bake, const BakeOptions& options);

    uint32_t rays() const { return rays_; }

    // Pose p as baked, with this transfer; in coordinates and axes of the scene.
    // noise  receives BakedPose::noise, unless it is null. [planes][V]
    DecodedPose pose(uint32_t p, std::vector<float>* noise = nullptr) const;

    // The still meshes with this transfer; nullptr if there are none.
    const DecodedPose* still() const { return still_ ? &*still_ : nullptr; }

  private:
    DecodedPose decoded(BakedPose baked) const;

    const BakeReader& bake_;
    uint32_t rays_;
    TransferBaker baker_;
    std::optional<DecodedPose> still_;
};

}  // namespace paim
