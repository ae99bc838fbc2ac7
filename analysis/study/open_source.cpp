// The sequences that studies measure.
#include "analysis/study/open_source.h"

#include "compressor/io/obj_files.h"
#include "compressor/io/obj_sequence.h"
#include "poses/octopus.h"
#include "poses/shapes.h"

namespace paim::study {

const char* const kInputsHelp = "OBJ files, patterns, folders; or 'octopus' or 'bowl'";

std::unique_ptr<PoseSource> open_source(const std::vector<std::string>& inputs,
                                        uint32_t num_vertices, uint32_t num_poses) {
    if (inputs == std::vector<std::string>{"octopus"}) {
        return std::make_unique<PoseSet>(poses::make_octopus(num_vertices, num_poses));
    }
    if (inputs == std::vector<std::string>{"bowl"}) {
        return std::make_unique<PoseSet>(
            poses::make_pose_set(*poses::make_bowl_sequence(num_vertices), num_poses));
    }
    return std::make_unique<ObjSequence>(find_obj_files(inputs, false));
}

}  // namespace paim::study
