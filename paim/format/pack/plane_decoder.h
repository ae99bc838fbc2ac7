// Decodes planes of small integers: Zstandard, then unpacking, then prediction from neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "paim/format/pack/plane_predictor.h"
#include "paim/format/pack/workspace.h"

namespace paim {

// Planes of a section of a file, and memory for their values.
template <typename Integer>
struct StoredPlanes {
    std::span<const uint8_t> bytes;  // the stored section; may be anything
    size_t num_planes = 0;           // at least 1
    std::span<Integer> out;          // [planes][N]
};

// Fills every `out`. Returns false for bytes that are not such planes, and for values outside the
// symmetric range of the integers. Several planes are reconstructed at once; kPlanesAtOnce of them
// are fastest. The memory taken depends on the sizes of `out` alone, not on the bytes.
template <typename Integer>
bool decode_planes(std::span<const StoredPlanes<Integer>> sections, const PlanePredictor& predictor,
                   Workspace& workspace);

template <typename Integer>
constexpr size_t kPlanesAtOnce = 64 / sizeof(Integer);

// The same for one section.
template <typename Integer>
bool decode_planes(std::span<const uint8_t> bytes, size_t num_planes,
                   const PlanePredictor& predictor, std::span<Integer> out) {
    Workspace workspace;
    const StoredPlanes<Integer> planes{bytes, num_planes, out};
    return decode_planes(std::span(&planes, 1), predictor, workspace);
}

}  // namespace paim
