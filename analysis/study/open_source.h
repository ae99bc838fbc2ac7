// The sequences that studies measure.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "paim/mesh/pose_source.h"

namespace paim::study {

// What --help says of the inputs.
extern const char* const kInputsHelp;

// inputs        OBJ files, patterns and folders, or the one word 'octopus' or 'bowl': a made-up
//               sequence
// num_vertices  of a made-up sequence
// num_poses     of a made-up sequence
// Errors: those of find_obj_files(), ObjSequence and the made-up sequences.
std::unique_ptr<PoseSource> open_source(const std::vector<std::string>& inputs,
                                        uint32_t num_vertices, uint32_t num_poses);

}  // namespace paim::study
