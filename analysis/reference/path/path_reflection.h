// What a point of a triangle reflects: the diffuse and the glossy reflection of its corners,
// interpolated.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "compressor/material/brdf.h"
#include "paim/mesh/materials.h"

namespace paim {

// Materials with their BRDFs.
struct PathMaterials {
    Materials materials;
    std::vector<std::shared_ptr<const Brdf>> brdfs;  // of each of materials.glossy
};

// Which reflection of a surface counts.
struct PathKinds {
    bool diffuse = true;
    bool glossy = true;
};

// Directions are in the frame of the point, whose z axis is the interpolated normal.
class PathReflection {
  public:
    // corners  vertices of a triangle
    // weights  of the corners, barycentric
    // Keeps pointers to the BRDFs.
    PathReflection(const PathMaterials& materials, const Albedo& albedo, const Triangle& corners,
                   const std::array<float, 3>& weights, const PathKinds& kinds);

    // Whether nothing is reflected.
    bool is_black() const { return share_of_cosine_ == 0.0; }

    // ρ/π + Σ tint · f, per channel, without the cosine of `in`.                       (1/sr)
    // in, out  unit, above the surface
    Vec3d value(const Vec3d& in, const Vec3d& out) const;

    // A direction of light that leaves towards `out`: of one of the terms, or in proportion to the
    // cosine. It may be below the surface.
    // u, v  0 … 1, uniform; u also chooses the term
    Vec3d sample(const Vec3d& out, double u, double v) const;
    double density(const Vec3d& in, const Vec3d& out) const;  // of sample(), 1/sr

  private:
    struct Lobe {
        const Brdf* brdf;
        Vec3d factor;  // weight of the corner · tint
        double share;  // of the samples
    };

    Vec3d diffuse_ = Vec3d::Zero();  // albedo
    std::array<Lobe, 3> lobes_;
    size_t num_lobes_ = 0;
    double share_of_cosine_ = 0.0;
};

}  // namespace paim
