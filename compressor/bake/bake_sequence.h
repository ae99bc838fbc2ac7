// Bakes a whole sequence into a .bake directory, pose by pose, going on where an earlier run
// stopped.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "compressor/bake/transfer_baker.h"
#include "compressor/scene/static_mesh.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"

namespace paim {

struct BakeSummary {
    uint32_t baked = 0;    // poses baked by this run
    uint32_t resumed = 0;  // poses found from an earlier one
    PoseStatistics total;  // of all poses in range; RMS values over all of them
};

// What a sequence stands on and among.
struct Surroundings {
    std::string floor;   // description of the ground that the poses have got; empty if none
    StaticMesh scenery;  // blocks and bounces the poses' light; baked once, without the poses
};

// What decides the bytes of the bake of this sequence with these options.
BakeIdentity bake_identity(const PoseSource& source, const BakeOptions& options,
                           const std::string& normals, const Surroundings& surroundings = {});

// Bakes poses first … last (inclusive), and scenery, that are not there yet.
// on_pose   called after each pose, found or baked, with its number
// Errors: those of BakeWriter, of the source and of RayScene. Finished poses stay whatever happens.
BakeSummary bake_sequence(const PoseSource& source, const BakeOptions& options,
                          const std::string& normals, const std::filesystem::path& directory,
                          uint32_t first, uint32_t last,
                          const std::function<void(uint32_t)>& on_pose,
                          const Surroundings& surroundings = {});

}  // namespace paim
