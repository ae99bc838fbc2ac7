// Cosine-distributed directions.
// Based on: Shirley and Chiu, A Low Distortion Map Between Disk and Square, 1997 (concentric map,
//           which keeps neighbouring points together). Projecting the disk onto the hemisphere
//           gives cosine density (Malley).
#include "compressor/bake/cosine_directions.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace paim {

namespace {

// Vector registers of SSE2 and NEON. GCC and Clang do arithmetic on these types directly. GCC 12
// does not vectorise this loop by itself; as scalar code it would take two and a half times as
// long.
constexpr uint32_t kLanes = 4;
using Floats = float __attribute__((vector_size(16)));
using Ints = int32_t __attribute__((vector_size(16)));
using Words = uint32_t __attribute__((vector_size(16)));

template <typename T>
T load(const void* from) {
    T lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

inline Floats select(Ints mask, Floats yes, Floats no) {
    return reinterpret_cast<Floats>((mask & reinterpret_cast<Ints>(yes)) |
                                    (~mask & reinterpret_cast<Ints>(no)));
}

// |x| as integers, which have the same order as the floats.
inline Ints magnitude(Floats x) {
    return reinterpret_cast<Ints>(x) & 0x7fffffff;
}

inline Floats square_root(Floats x) {
    for (uint32_t lane = 0; lane < kLanes; ++lane) x[lane] = std::sqrt(x[lane]);
    return x;
}

// scrambled_fraction() of four coordinates, scaled to [−1, 1).
inline Floats signed_fraction(Words reversed, uint32_t seed) {
    const Words scrambled = reverse_bits(laine_karras_permutation(reversed, seed)) >> 8;
    // 24 bits are exact in float. SSE2 can only convert signed numbers.
    const Floats integer = __builtin_convertvector(reinterpret_cast<Ints>(scrambled), Floats);
    return integer * 0x1.0p-23f - 1.0f;
}

// sin and cos for |x| <= π/4 by Taylor series, with errors below the rounding of floats.
inline Floats small_sin(Floats x) {
    const Floats s = x * x;
    return x *
           (1.0f + s * (-1.0f / 6 + s * (1.0f / 120 + s * (-1.0f / 5040 + s * (1.0f / 362880)))));
}

inline Floats small_cos(Floats x) {
    const Floats s = x * x;
    return 1.0f + s * (-0.5f + s * (1.0f / 24 + s * (-1.0f / 720 + s * (1.0f / 40320))));
}

}  // namespace

void orthonormal_basis(const Vec3f& normal, Vec3f& tangent, Vec3f& bitangent) {
    const float sign = std::copysign(1.0f, normal.z());
    const float a = -1.0f / (sign + normal.z());
    const float b = normal.x() * normal.y() * a;
    tangent = Vec3f(1.0f + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
    bitangent = Vec3f(b, sign + normal.y() * normal.y() * a, -normal.y());
}

CosineDirections::CosineDirections(uint32_t first, uint32_t count)
    : count_(count), points_(first, count) {
    const uint32_t padded = DirectionArrays::padded(count);
    points_.reversed_x.resize(padded, 0);
    points_.reversed_y.resize(padded, 0);
}

void CosineDirections::generate(const Vec3f& normal, uint64_t key, DirectionArrays& out) const {
    Vec3f tangent, bitangent;
    orthonormal_basis(normal, tangent, bitangent);
    const auto seed_x = static_cast<uint32_t>(key);
    const auto seed_y = static_cast<uint32_t>(key >> 32);
    const uint32_t padded = padded_count();
    out.x.resize(padded);
    out.y.resize(padded);
    out.z.resize(padded);
    float* const to[3] = {out.x.data(), out.y.data(), out.z.data()};
    // Two loops, each so short that the processor can overlap its steps.
    for (uint32_t j = 0; j < padded; j += kLanes) {
        const Floats a = signed_fraction(load<Words>(points_.reversed_x.data() + j), seed_x);
        const Floats b = signed_fraction(load<Words>(points_.reversed_y.data() + j), seed_y);
        std::memcpy(to[0] + j, &a, sizeof a);
        std::memcpy(to[1] + j, &b, sizeof b);
    }
    const Vec3f n = normal;  // a copy: the compiler knows that the stores below do not change it
    for (uint32_t j = 0; j < padded; j += kLanes) {
        const Floats a = load<Floats>(to[0] + j);
        const Floats b = load<Floats>(to[1] + j);
        // Concentric map: the larger coordinate is the signed radius, their ratio the angle from
        // its axis.
        const Ints first = magnitude(a) > magnitude(b);
        const Floats radius = select(first, a, b);
        const Floats other = select(first, b, a);
        const Floats safe_radius = select(radius == 0.0f, Floats{} + 1.0f, radius);
        const Floats angle = static_cast<float>(kPi / 4) * (other / safe_radius);
        const Floats along = radius * small_cos(angle);
        const Floats across = radius * small_sin(angle);
        const Floats disk_x = select(first, along, across);
        const Floats disk_y = select(first, across, along);
        const Floats height2 = 1.0f - disk_x * disk_x - disk_y * disk_y;
        const Floats height = square_root(select(height2 > 0.0f, height2, Floats{}));
        for (int axis = 0; axis < 3; ++axis) {
            const Floats w = disk_x * tangent[axis] + disk_y * bitangent[axis] + height * n[axis];
            std::memcpy(to[axis] + j, &w, sizeof w);
        }
    }
    std::fill(out.x.begin() + count_, out.x.end(), 0.0f);
    std::fill(out.y.begin() + count_, out.y.end(), 0.0f);
    std::fill(out.z.begin() + count_, out.z.end(), 0.0f);
}

}  // namespace paim
