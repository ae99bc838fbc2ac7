// Bakes a whole sequence into a .bake directory, pose by pose. Resumes where an earlier run
// stopped.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "compressor/bake/transfer_baker.h"
#include "compressor/scene/still_mesh.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"
#include "paim/mesh/root_motion.h"

namespace paim {

struct BakeSummary {
    uint32_t baked = 0;    // poses baked by this run
    uint32_t resumed = 0;  // poses found from an earlier one
    PoseStatistics total;  // of all poses in range; RMS values over all of them
};

// The floor and the still meshes of a sequence.
struct Surroundings {
    std::string floor;     // description of the ground under the poses; empty if there is none
    StillMesh still_mesh;  // blocks and bounces the poses' light; baked once, without the poses
};

// The identity of this bake: everything that decides its bytes.
// root_motion  of all poses, relative to the origin of the source (scene/root_motion.h); or empty
BakeIdentity bake_identity(const PoseSource& source, const BakeOptions& options,
                           const std::string& normals, const Surroundings& surroundings = {},
                           const RootMotion& root_motion = {});

// Bakes the poses first … last (inclusive) and the still mesh, unless they are baked already. With a
// root motion the bake holds poses in local coordinates. Where the source has offsets of poses
// (PoseSource::pose_offset) there must be a root motion, or the positions are relative to the origin
// in floats.
// on_pose   called with the number of each pose once it is baked or found
// Errors: those of BakeWriter, of the source and of RayScene. Finished poses stay in any case.
BakeSummary bake_sequence(const PoseSource& source, const BakeOptions& options,
                          const std::string& normals, const std::filesystem::path& directory,
                          uint32_t first, uint32_t last,
                          const std::function<void(uint32_t)>& on_pose,
                          const Surroundings& surroundings = {},
                          const RootMotion& root_motion = {});

}  // namespace paim
