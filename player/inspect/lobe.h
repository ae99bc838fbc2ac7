// Functions on the sphere as surfaces: a basis function, or the transfer of one vertex.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim::player {

// The surface |f(ω)| ω, scaled so that its largest radius is 1. All points are the origin where f is
// zero.
struct Lobe {
    std::vector<float> values;     // [N] f
    std::vector<Vec3f> positions;  // [N]
    std::vector<Vec3f> colors;     // [N] linear RGB: signed_color() of f
    float largest = 0.0f;          // the largest |f|
};

// The same directions for every lobe: an icosahedron whose faces were cut into four, four times.
// Basis values are kept, bands² · N floats (2.5 MB for 16 bands).
class LobeShape {
  public:
    // bands  1 … sh::kMaxBands
    explicit LobeShape(int bands);

    static constexpr uint32_t kNumVertices = 2562;
    int bands() const { return bands_; }
    // Counter-clockwise from outside, as long as the lobe does not turn itself inside out.
    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::vector<Vec3f>& directions() const { return directions_; }  // [N] unit

    // f = Σ_i coefficients[i] y_i, in the axes of the coefficients (docs/conventions.md).
    // coefficients  at most bands²; those that are missing are zero
    // out           reuses its memory
    void of(std::span<const float> coefficients, Lobe& out) const;

    // f = y_i. i < bands² (checked)
    void of_basis(uint32_t i, Lobe& out) const;

  private:
    void finish(Lobe& out) const;

    int bands_;
    std::vector<Triangle> triangles_;
    std::vector<Vec3f> directions_;
    std::vector<float> basis_;  // [bands²][N]
};

// The transfer of one vertex, as a function of the direction of light: what radiance of a white
// vertex, albedo 1, is per unit of light from there.
// transfer  [layout.num_planes()][V]
// channel   0 … 2, or kLuminance (transfer_channel.h)
// returns   [layout.num_coefficients()]
std::vector<float> vertex_transfer(const TransferLayout& layout, std::span<const float> transfer,
                                   uint32_t vertex, uint32_t channel);

}  // namespace paim::player
