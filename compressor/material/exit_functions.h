// How a BRDF spreads light over the sphere of outgoing directions, in spherical harmonics.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002, section 6; Kautz, Sloan and Snyder,
//           Fast, Arbitrary BRDF Shading for Low-Frequency Lighting Using Spherical Harmonics, 2002
#pragma once

#include <vector>

#include "compressor/material/brdf.h"
#include "compressor/material/lobe_quadrature.h"
#include "paim/sh/basis.h"

namespace paim {

// Light of unit radiance from direction s, of a small solid angle ds, leaves with the radiance
// f(s, v) cos θ_s ds towards v. Below the surface the mirror image f(s, v') continues it, where v'
// is v mirrored at the surface. The outgoing coefficients of both are
//
//     b_o(s) = cos θ_s e_o(s)        e_o(s) = 2 ∫ f(s, v) y_o(v) dv     over the upper hemisphere
//
// for even l + m, and zero for odd. The BRDF is isotropic, so that, for o = l(l+1) + m,
//
//     e_o(s) = ε_l|m|(cos θ_s) · (cos mφ_s for m ≥ 0, sin |m|φ_s for m < 0).
//
// ε is tabulated (docs/algorithms/gloss.md). Everything is in the frame of the surface, with the
// normal z.
class ExitFunctions {
  public:
    static constexpr int kBatch = 16;
    static constexpr int kMaxBands = 16;

    // out_bands  1 … kMaxBands
    // err   of cos θ ε, relative to its largest value for l = m = 0, from the linear interpolation of
    //       the table: 1e-4 for up to 8 bands, exponents of Phong up to 10,000 and roughness from
    //       0.1; 3e-3 near the horizon at roughness 0.02
    // cost  0.4 to 0.9 s on one core for 8 bands; uses all cores
    ExitFunctions(const Brdf& brdf, int out_bands);

    int out_bands() const { return out_bands_; }

    // The outgoing coefficients that are not zero, in the order of rows below; [K], those of one |m|
    // of one band follow one another.
    const std::vector<int>& coefficients() const { return coefficients_; }
    int num_rows() const { return static_cast<int>(coefficients_.size()); }

    // e_o for many directions at once.
    // x, y, z  [kBatch] unit directions above the surface, or zero
    // values   [K][kBatch]
    void evaluate(const float* x, const float* y, const float* z, float* values) const;

    // ε_l|m| for one direction, in double: what evaluate() computes.
    // l + |m| even, l < out_bands; 0 ≤ cosine ≤ 1
    double at(int l, int abs_m, double cosine) const;

    // The share of the light from a direction that is reflected (directional albedo):
    // ∫ f(s, v) cos θ_v dv.
    // err  as that of cos θ ε
    double albedo(double cosine) const;

    // The table has the cosines cosine_of(k / kCells), and is linear in the coordinate between them.
    // Cells are short near grazing angles, and as long as angles at the normal.
    static constexpr int kCells = 1024;
    // coordinate  0 (the normal) … 1 (the horizon)
    static double cosine_of(double coordinate) {
        const double root = 1.0 - coordinate * coordinate;
        return root * root;
    }

  private:
    struct Entry {
        int l, m;
    };
    // Σ_l (l / 2 + 1), which is a multiple of a register.
    static constexpr int kMaxEntries = kMaxBands * (kMaxBands + 2) / 4;

    void fill_node(const sh::BatchBasis& basis, const std::vector<LobeQuadrature::Point>& points,
                   size_t node);
    void look_up(const float* coordinate, float (*entries)[kBatch]) const;
    // Column c of the table, [nodes][stride_], at a cosine.
    double interpolate(const std::vector<float>& table, size_t stride, size_t c,
                       double cosine) const;

    int out_bands_;
    std::vector<Entry> entries_;  // l + m even, m ≥ 0
    std::vector<int> coefficients_;
    size_t stride_;              // entries, rounded up to whole registers
    std::vector<float> table_;   // [nodes][stride_]
    std::vector<float> albedo_;  // [nodes]
};

}  // namespace paim
