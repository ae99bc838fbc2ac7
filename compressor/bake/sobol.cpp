// Two-dimensional Sobol points.
// Based on: Sobol', On the Distribution of Points in a Cube, 1967; direction numbers of the second
//           dimension from the primitive polynomial x + 1
#include "compressor/bake/sobol.h"

#include <algorithm>

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

// Interleaves the bits of x and y, the highest first.
// Based on: G. M. Morton, A Computer Oriented Geodetic Data Base, 1966
uint64_t morton_code(uint32_t x, uint32_t y) {
    uint64_t code = 0;
    for (uint32_t bit = 32; bit-- > 0;) code = code << 2 | (x >> bit & 1u) << 1 | (y >> bit & 1u);
    return code;
}

struct OrderedPoint {
    uint64_t code;
    uint32_t index;
    auto operator<=>(const OrderedPoint&) const = default;
};

}  // namespace

SobolPoints::SobolPoints(uint32_t first, uint32_t count) : reversed_x(count), reversed_y(count) {
    std::vector<OrderedPoint> points(count);
    for (uint32_t j = 0; j < count; ++j) {
        const uint32_t index = first + j;
        points[j] = {morton_code(reverse_bits(index), reverse_bits(reversed_second(index))), index};
    }
    std::sort(points.begin(), points.end());
    for (uint32_t j = 0; j < count; ++j) {
        reversed_x[j] = points[j].index;
        reversed_y[j] = reversed_second(points[j].index);
    }
}

}  // namespace paim
