// The input of a bake of paim-compress: poses from OBJ files, their floor, and still meshes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "compressor/bake/bake_sequence.h"
#include "compressor/bake_report.h"
#include "compressor/io/obj_sequence.h"
#include "compressor/options.h"

namespace paim {

class BakeInput {
  public:
    // Reads and checks every file. Shows progress and prints warnings on stderr.
    // Errors: those of ObjSequence, PosesOnFloor and StillMesh; usage for a range of poses that
    // does not exist.
    explicit BakeInput(const CompressOptions& options);

    const PoseSource& poses() const;
    const Surroundings& surroundings() const { return surroundings_; }
    const RootMotion& root_motion() const { return root_motion_; }
    uint32_t first_pose() const { return first_pose_; }
    uint32_t last_pose() const { return last_pose_; }  // inclusive

    // The layout of the planes of the bake.
    TransferLayout layout(const BakeOptions& options) const;

    // A report about the input, without the results of baking.
    BakeReport report() const;

  private:
    void add_floor(const CompressOptions& options);
    void find_motion(const CompressOptions& options);
    void add_still_mesh(const CompressOptions& options, const std::string& file);

    ObjSequence sequence_;
    TopologyReport topology_;  // of the poses without their floor
    uint32_t first_pose_ = 0, last_pose_ = 0;
    std::optional<PosesOnFloor> on_floor_;
    Surroundings surroundings_;
    RootMotion root_motion_;
    std::vector<StillMeshReport> still_meshes_;
    bool has_library_gloss_ = false;  // of poses or still meshes
};

}  // namespace paim
