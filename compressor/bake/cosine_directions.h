// Cosine-distributed directions about a normal: a lattice on a spiral, whole or in two halves.
// Based on: Marques, Bouville, Ribardière, Santos and Bouatouch, Spherical Fibonacci Point Sets for
//           Illumination Integrals, 2013 (lattices on spirals); Vogel, A Better Way to Construct
//           the Sunflower Head, 1979
#pragma once

#include <cstdint>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

// Directions as a structure of arrays, padded with zeros to a multiple of 16.
struct DirectionArrays {
    std::vector<float> x, y, z;

    // The length of the arrays of this many directions.
    static constexpr uint32_t padded(uint32_t count) { return (count + 15) / 16 * 16; }
};

// Sets of directions whose density over the hemisphere is cos θ / π. Point j of n has, on the disk
// below the hemisphere,
//
//     radius² = (j + shift) / n        angle = 2π (j / √2 + turn),
//
// where shift and turn are uniform random numbers of the set. Each point is then uniform in its
// ring, and all together are unbiased, for any n. Near any place the points are a lattice, which
// counts areas with less error than a scrambled net of as many points.
//
// A set can be had in two parts of n / 2 points: those of even j, which step by √2 turns, and those
// of odd j. As numbers, points are a √2 + b for integer a and b = j, and even b are the multiples of
// √2: a part is a lattice of the same kind, as good as a set of n / 2 points. A random bit of the set
// says which part is which, so that each is unbiased.
class CosineDirections {
  public:
    // num_points  a multiple of num_parts
    // num_parts   1 or 2
    CosineDirections(uint32_t num_points, uint32_t num_parts);

    // Of a part.
    uint32_t count() const { return count_; }

    // normal  unit
    // key     of the random numbers of the set, the same for all of its parts
    // out     resized to padded(count()); sixteen neighbours follow one another
    void generate(const Vec3f& normal, uint64_t key, uint32_t part, DirectionArrays& out) const;

  private:
    // Padded with zeros.
    struct Part {
        std::vector<float> ring;          // j / n
        std::vector<float> cosine, sine;  // of 2π j / √2
    };

    uint32_t num_points_;
    uint32_t count_;
    std::vector<Part> parts_;
};

}  // namespace paim
