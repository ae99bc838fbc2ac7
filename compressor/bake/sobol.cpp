// Two-dimensional Sobol points.
// Based on: Sobol', On the Distribution of Points in a Cube, 1967; direction numbers of the second
//           dimension from the primitive polynomial x + 1
#include "compressor/bake/sobol.h"

namespace paim {

namespace {

// The second coordinate of point j with reversed bits. The first coordinate with reversed bits is
// j.
uint32_t reversed_second(uint32_t j) {
    uint32_t y = 0;
    uint32_t direction = 0x80000000u;  // v_{j+1} = v_j ^ (v_j >> 1)
    for (; j != 0; j >>= 1) {
        if (j & 1u) y ^= direction;
        direction ^= direction >> 1;
    }
    return reverse_bits(y);
}

}  // namespace

SobolPoints::SobolPoints(uint32_t count) : reversed_x(count), reversed_y(count) {
    for (uint32_t j = 0; j < count; ++j) {
        reversed_x[j] = j;
        reversed_y[j] = reversed_second(j);
    }
}

}  // namespace paim
