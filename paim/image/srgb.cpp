// The sRGB curve as a table.
#include "paim/image/srgb.h"

#include <cmath>

namespace paim {

namespace {

std::array<float, 256> make_table() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
        const double display = static_cast<double>(i) / 255.0;
        table[i] = static_cast<float>(
            display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4));
    }
    return table;
}

}  // namespace

float srgb_to_linear(uint8_t value) {
    static const std::array<float, 256> table = make_table();
    return table[value];
}

Vec3f srgb_to_linear(const Rgb8& color) {
    return {srgb_to_linear(color[0]), srgb_to_linear(color[1]), srgb_to_linear(color[2])};
}

}  // namespace paim
