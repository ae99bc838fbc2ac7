// Cosine-distributed directions about a normal: keyed low-discrepancy sequences.
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/bake/sobol.h"
#include "paim/base/vector.h"

namespace paim {

// Directions as a structure of arrays, padded with zeros to a multiple of 16.
struct DirectionArrays {
    std::vector<float> x, y, z;

    // The length of the arrays of this many directions.
    static constexpr uint32_t padded(uint32_t count) { return (count + 15) / 16 * 16; }
};

// Directions [first, first + count) of a sequence whose density over the hemisphere is cos θ / π.
// Each key gives an independent, unbiased sequence.
class CosineDirections {
  public:
    CosineDirections(uint32_t first, uint32_t count);

    uint32_t count() const { return count_; }
    uint32_t padded_count() const { return static_cast<uint32_t>(points_.reversed_x.size()); }

    // normal  unit
    // out     resized to padded_count()
    void generate(const Vec3f& normal, uint64_t key, DirectionArrays& out) const;

  private:
    uint32_t count_;
    SobolPoints points_;
};

// Two unit vectors that make a right-handed basis with the unit normal.
// Based on: Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin, Building an Orthonormal
//           Basis, Revisited, JCGT 6(1), 2017
void orthonormal_basis(const Vec3f& normal, Vec3f& tangent, Vec3f& bitangent);

}  // namespace paim
