// Planes of a decoded animation over all of its poses, of any codec. Errors are measured on them.
#pragma once

#include <Eigen/Core>

#include <cstdint>

#include "paim/codec/asset.h"

namespace paim {

// Decodes plane 0 … 2 of the positions (scene units), or plane layout.plane(channel, i) of the
// transfer.
// returns [V][P]
Eigen::MatrixXf decode_plane(const CodedMesh& mesh, Attribute attribute, uint32_t plane);

}  // namespace paim
