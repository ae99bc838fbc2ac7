// Two-dimensional Sobol points with hash-based Owen scrambling.
// Based on: Brent Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020, after Laine and
//           Karras, Stratified Sampling for Stochastic Transparency, 2011; Sobol', 1967
#pragma once

#include <cstdint>
#include <vector>

namespace paim {

// The first points of the (0, 2)-sequence, each coordinate a 32-bit fraction with its bits reversed,
// which is the form that scrambling works on.
struct SobolPoints {
    std::vector<uint32_t> reversed_x;
    std::vector<uint32_t> reversed_y;

    explicit SobolPoints(uint32_t count);
};

constexpr uint32_t reverse_bits(uint32_t x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// Permutes so that every bit depends only on itself, the seed and lower bits: an Owen scramble when
// the bits are reversed. The constants are Nathan Vegdahl's, with better avalanche than Burley's:
// "Building a Better LK Hash", 2021.
constexpr uint32_t laine_karras_permutation(uint32_t x, uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// A scrambled coordinate as a fraction in [0, 1), from its reversed bits.
constexpr float scrambled_fraction(uint32_t reversed, uint32_t seed) {
    const uint32_t scrambled = reverse_bits(laine_karras_permutation(reversed, seed));
    return static_cast<float>(scrambled >> 8) * 0x1.0p-24f;
}

}  // namespace paim
