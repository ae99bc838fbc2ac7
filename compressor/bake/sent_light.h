// The light that all vertices of a scene send out, after some number of bounces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/bounces.h"
#include "compressor/bake/gloss_pass.h"
#include "compressor/bake/surface_hits.h"

namespace paim {

// Light that bounced b times: diffuse transfer [2][channels][V][C], and glossy transfer
// [2][channels][R][O · C'], where C' is the coefficients of its own light.
struct GlossyTerm {
    BounceTerm diffuse;
    BounceTerm gloss;
};

// The reflections of one mesh.
struct ReflectingMesh {
    size_t num_vertices = 0;
    const Albedo* albedo = nullptr;
    const GlossRows* rows = nullptr;
};

// Of one half. A vertex sends albedo · t_i + tint · Σ_o T_oi y_o(v) towards v, for each coefficient i of
// light. Between vertices the products are interpolated.
class SentLight {
  public:
    // layout, gloss_layout  of the same channels
    SentLight(const TransferLayout& layout, const TransferLayout& gloss_layout);

    // Makes room for so many vertices and rows of all meshes, so that adding them copies nothing.
    void reserve(size_t num_vertices, size_t num_rows);

    // Adds the vertices of a mesh after those that are there.
    void add(const ReflectingMesh& mesh, const GlossyTerm& term, size_t half);

    // Coefficients of light of either transfer, the larger number.
    size_t num_light() const { return num_light_; }

    // What leaves a hit towards `direction`.
    // radiance  [channels][num_light()]
    void at(const SurfaceHit& hit, const Vec3d& direction, std::span<float> radiance) const;

  private:
    static constexpr uint32_t kMatte = ~uint32_t{0};

    const TransferLayout layout_, gloss_layout_;
    const size_t num_light_;
    std::vector<float> diffuse_;    // [V][channels][C]
    std::vector<uint32_t> row_of_;  // [V] or kMatte
    std::vector<float> gloss_;      // [R][channels][O][C']
};

}  // namespace paim
