// Planes from packed residuals: many planes at once.
#pragma once

#include <cstdint>
#include <span>

#include "paim/format/plane_packing.h"
#include "paim/format/plane_predictor.h"
#include "paim/format/scratch_pool.h"

namespace paim {

struct PackedPlane {
    PlaneHeader header;               // valid
    const uint8_t* source = nullptr;  // [packed_size()] any bytes
};

// out [planes][N] = what PlanePredictor::add() makes of each plane's residuals. False if a value does
// not fit: out then holds anything.
// predictor  of N points, unless no plane is predicted
// rows       to work in: up to 64 bytes a point
template <typename Integer>
bool undo_planes(std::span<const PackedPlane> planes, const PlanePredictor& predictor,
                 size_t num_points, ScratchPool::Buffer& rows, Integer* out);

}  // namespace paim
