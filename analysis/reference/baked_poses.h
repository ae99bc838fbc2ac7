// The poses of a bake, as if they were read from files, to be baked again.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "compressor/bake/bake_options.h"
#include "compressor/bake/bake_sequence.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"

namespace paim {

// Positions and normals are those of the bake, in the scene. Where the bake has a root motion they are
// rounded once more than in the files.
class BakedPoses : public PoseSource {
  public:
    // Keeps a reference to the bake.
    explicit BakedPoses(const BakeReader& bake) : bake_(bake) {}

    const Topology& topology() const override { return bake_.topology(); }
    const Albedo& albedo() const override { return bake_.albedo(); }
    uint32_t num_poses() const override { return bake_.num_poses(); }
    Vec3d origin() const override { return bake_.identity().origin; }
    uint32_t num_moving_vertices() const override;
    std::string pose_name(uint32_t p) const override { return bake_.identity().poses[p].name; }
    uint64_t pose_checksum(uint32_t p) const override { return bake_.identity().poses[p].xxh3; }
    Pose load_pose(uint32_t p) const override;

  private:
    const BakeReader& bake_;
};

// The floor and the still meshes of a bake.
Surroundings surroundings_of(const BakeReader& bake);

// The options that a bake was made with, but for noise targets and samplers: those become a fixed count
// of rays by the default sampler.
BakeOptions options_of(const BakeIdentity& identity);

// Bakes all poses of a bake again, its floor and still meshes with them, into another directory.
// on_pose  called after each pose
// Errors: those of bake_sequence().
void bake_again(const BakeReader& bake, const BakeOptions& options,
                const std::filesystem::path& directory,
                const std::function<void(uint32_t)>& on_pose);

}  // namespace paim
