// Estimates of the glossy transfer of a vertex from each half of its rays.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002, section 6
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/gloss_reflections.h"
#include "compressor/bake/vertex_frame.h"
#include "paim/sh/basis.h"

namespace paim {

// With cosine-distributed rays s_j and the exit functions e_o of the material,
//
//     T_oi = ∫ V(s) b_o(s) y_i(s) ds = π · the mean of V(s_j) e_o(s_j) y_i(s_j),
//
// as the density is cos θ / π and b_o = cos θ e_o. The estimate has the control variate of
// estimate_half() (split_estimate.h), whose integral is open_gloss(). e_o is in the frame of the vertex
// until the end; y_i is in the axes of the pose.
// Each thread needs its own.
class GlossSums {
  public:
    // basis   of as many bands as the layout has of light
    // layout  its channels do not matter
    // Keeps a reference to the basis.
    GlossSums(const sh::BatchBasis& basis, const TransferLayout& layout);

    // Begins a half of the rays of a vertex. Keeps references to both.
    void start(const GlossReflection& reflection, const VertexFrame& frame);

    // Adds Σ_j weight · (weight of ray j) · factors[j] · e_o(s_j) y_i(s_j), and counts the points.
    // rays     cosine-weighted
    // factors  [padded rays]
    void add(const RaySet& rays, std::span<const float> factors, double num_points, double weight);

    // c · open_gloss() + π · sums / points, in the axes of the pose.
    // estimate  [O][C]
    void estimate(double c, std::span<double> estimate);

  private:
    void add_packet(const RaySet& rays, size_t first, const float* weights);
    void flush(double weight);
    // Adds c times a row of open_gloss(), whose light has the order m alone, in the axes of the pose.
    void add_open(const double* open, int m, double c, double* sums) const;

    const sh::BatchBasis& basis_;
    const TransferLayout layout_;
    const size_t num_in_;  // C
    const GlossReflection* reflection_ = nullptr;
    const VertexFrame* frame_ = nullptr;
    std::vector<double> sums_;  // [K][C]
    std::vector<float> lanes_;  // [K][C][4], of some packets
    std::vector<float> exit_;   // [K][16]
    std::vector<float> light_;  // [C][16]
    double num_points_ = 0.0;   // times their weights
};

}  // namespace paim
