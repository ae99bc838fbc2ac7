// Two-dimensional Sobol points.
// Based on: Sobol', On the Distribution of Points in a Cube, 1967; direction numbers of the second
//           dimension from the primitive polynomial x + 1
#include "compressor/bake/sobol.h"

namespace paim {

SobolPoints::SobolPoints(uint32_t count) : reversed_x(count), reversed_y(count) {
    // The first coordinate is the index with its bits reversed; reversed once more, the index itself.
    // The second one's direction numbers are v_{j+1} = v_j ^ (v_j >> 1).
    for (uint32_t j = 0; j < count; ++j) {
        reversed_x[j] = j;
        uint32_t y = 0;
        uint32_t direction = 0x80000000u;
        for (uint32_t bits = j; bits != 0; bits >>= 1) {
            if (bits & 1u) y ^= direction;
            direction ^= direction >> 1;
        }
        reversed_y[j] = reverse_bits(y);
    }
}

}  // namespace paim
