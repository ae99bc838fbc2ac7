// What the transfer of one vertex consists of. Nobody else assumes "bands² floats".
#pragma once

#include <cstdint>

#include "paim/sh/index.h"

namespace paim {

enum class TransferKind : uint32_t {
    diffuse = 0,  // albedo-free, divided by π (docs/algorithms/transfer.md, E1)
};

// Values are stored plane by plane: plane = channel · bands² + i, each contiguous over the
// vertices, so row r = plane · V + v of a data matrix belongs to vertex v.
struct TransferLayout {
    TransferKind kind = TransferKind::diffuse;
    uint32_t bands = 0;     // 1 … sh::kMaxBands
    uint32_t channels = 1;  // 1 (grey) or 3

    uint32_t num_coefficients() const { return bands * bands; }
    uint32_t num_planes() const { return channels * bands * bands; }
    uint32_t plane(uint32_t channel, uint32_t i) const { return channel * bands * bands + i; }
    uint32_t band_of_plane(uint32_t plane) const {
        return static_cast<uint32_t>(sh::band_of(static_cast<int>(plane % num_coefficients())));
    }

    bool operator==(const TransferLayout&) const = default;
};

}  // namespace paim
