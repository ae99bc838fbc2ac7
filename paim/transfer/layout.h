// The values that the transfer of one vertex consists of. Only this file computes bands².
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "paim/sh/index.h"

namespace paim {

// The most bands of outgoing radiance.
constexpr uint32_t kMaxOutBands = 8;

enum class TransferKind : uint32_t {
    diffuse = 0,  // albedo-free, divided by π (docs/algorithms/transfer.md, E1)
    // With the BRDF of its brightest channel (docs/algorithms/gloss.md). Outgoing radiance is in the
    // frame of the vertex (mesh/tangent_frames.h), and even in z.
    glossy = 1,
    // The same with outgoing radiance in the axes of the pose. In memory only.
    glossy_in_pose = 2,
};

// Transfer maps in_bands² coefficients of incident light to O coefficients of outgoing radiance, in one
// or three channels. Diffuse transfer has one outgoing band: radiance is the same in every direction.
// Glossy transfer in frames has the even coefficients alone, O = out_bands (out_bands + 1) / 2. Values
// are stored plane by plane, each contiguous over the vertices:
//   plane = (channel · O + o) · in_bands² + i,
// so row r = plane · V + v of a data matrix belongs to vertex v.
struct TransferLayout {
    TransferKind kind = TransferKind::diffuse;
    uint32_t in_bands = 0;   // of light, 1 … sh::kMaxBands
    uint32_t channels = 1;   // 1 (grey) or 3
    uint32_t out_bands = 1;  // of outgoing radiance; 1: diffuse

    // Coefficients of light that one outgoing coefficient of one channel depends on.
    uint32_t num_coefficients() const { return squared(in_bands); }
    uint32_t num_outgoing() const {
        const int bands = static_cast<int>(out_bands);
        return static_cast<uint32_t>(is_even() ? sh::num_even_coefficients(bands)
                                               : sh::num_coefficients(bands));
    }
    uint32_t num_planes() const { return channels * num_outgoing() * num_coefficients(); }
    uint32_t plane(uint32_t channel, uint32_t i, uint32_t o = 0) const {
        return (channel * num_outgoing() + o) * num_coefficients() + i;
    }
    // The band of the light that a plane multiplies.
    uint32_t input_band(uint32_t plane) const { return band(plane % num_coefficients()); }
    // The band of the outgoing radiance that a plane contributes to.
    uint32_t output_band(uint32_t plane) const {
        const uint32_t o = plane / num_coefficients() % num_outgoing();
        return is_even() ? static_cast<uint32_t>(sh::band_of_even(static_cast<int>(o))) : band(o);
    }

    // The same layout with at most `most` bands of light, and at least one.
    TransferLayout with_bands(uint32_t most) const {
        TransferLayout layout = *this;
        layout.in_bands = std::min(std::max(most, 1u), in_bands);
        return layout;
    }

    // Glossy transfer in the axes of the pose, as it is stored: in frames.
    TransferLayout in_frames() const {
        TransferLayout layout = *this;
        layout.kind = TransferKind::glossy;
        return layout;
    }

    bool operator==(const TransferLayout&) const = default;

  private:
    bool is_even() const { return kind == TransferKind::glossy; }
    static uint32_t squared(uint32_t bands) {
        return static_cast<uint32_t>(sh::num_coefficients(static_cast<int>(bands)));
    }
    static uint32_t band(uint32_t i) {
        return static_cast<uint32_t>(sh::band_of(static_cast<int>(i)));
    }
};

// The numbers in `whole` of the planes of `part`, which is the same layout with fewer bands, in the
// order of `part`.
inline void planes_of(const TransferLayout& whole, const TransferLayout& part,
                      std::vector<uint32_t>& planes) {
    planes.clear();
    for (uint32_t channel = 0; channel < part.channels; ++channel) {
        for (uint32_t o = 0; o < part.num_outgoing(); ++o) {
            for (uint32_t i = 0; i < part.num_coefficients(); ++i) {
                planes.push_back(whole.plane(channel, i, o));
            }
        }
    }
}

}  // namespace paim
