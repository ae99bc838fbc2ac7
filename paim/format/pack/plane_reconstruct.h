// Reconstructs planes from packed residuals, many planes at once.
#pragma once

#include <cstdint>
#include <span>

#include "paim/format/pack/packed_plane.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/format/pack/workspace.h"

namespace paim {

// A packed plane of a file, and memory for its values.
template <typename Integer>
struct PlaneSource {
    PlaneHeader header;  // valid
    // Any bytes. symbols [symbol_bytes()]; the others [num_escapes], as in PackedPlane.
    const uint8_t* symbols = nullptr;
    const uint8_t* gaps = nullptr;
    const uint8_t* lows = nullptr;
    const uint8_t* highs = nullptr;
    Integer* out = nullptr;  // [N]
};

// Fills the `out` of every plane, with the same result as add_prediction() of its residuals.
// Returns false if an escape lies outside its plane, or if a value is the lowest of its type, which
// files do not use; `out` is then undefined.
// planes     are reordered
// predictor  of N points, unless no plane is predicted
// rows       scratch memory: up to 64 bytes a point
template <typename Integer>
bool reconstruct_planes(std::span<PlaneSource<Integer>> planes, const PlanePredictor& predictor,
                        size_t num_points, Buffer& rows);

}  // namespace paim
