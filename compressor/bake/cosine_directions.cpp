// Cosine-distributed directions.
// Based on: Shirley and Chiu, A Low Distortion Map Between Disk and Square, 1997 (concentric, so that
//           neighbouring points stay neighbours); projecting the disk up gives cosine density (Malley)
#include "compressor/bake/cosine_directions.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

constexpr uint32_t kPadding = 16;

// sin and cos for |x| <= π/4, Taylor series to below float rounding; branch-free, so that loops over
// directions become vector code.
inline float small_sin(float x) {
    const float s = x * x;
    return x * (1.0f + s * (-1.0f / 6 + s * (1.0f / 120 + s * (-1.0f / 5040 + s * (1.0f / 362880)))));
}

inline float small_cos(float x) {
    const float s = x * x;
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

CosineDirections::CosineDirections(uint32_t count)
    : count_(count), points_((count + kPadding - 1) / kPadding * kPadding) {}

void CosineDirections::generate(const Vec3f& normal, uint64_t key, DirectionArrays& out) const {
    Vec3f tangent, bitangent;
    orthonormal_basis(normal, tangent, bitangent);
    const auto seed_x = static_cast<uint32_t>(key);
    const auto seed_y = static_cast<uint32_t>(key >> 32);
    const uint32_t padded = padded_count();
    out.x.resize(padded);
    out.y.resize(padded);
    out.z.resize(padded);
    const uint32_t* reversed_x = points_.reversed_x.data();
    const uint32_t* reversed_y = points_.reversed_y.data();
    float* x = out.x.data();
    float* y = out.y.data();
    float* z = out.z.data();
    for (uint32_t j = 0; j < padded; ++j) {
        const float a = 2.0f * scrambled_fraction(reversed_x[j], seed_x) - 1.0f;
        const float b = 2.0f * scrambled_fraction(reversed_y[j], seed_y) - 1.0f;
        // Concentric map: the larger coordinate is the signed radius, their ratio the angle from its axis.
        const bool first = std::abs(a) > std::abs(b);
        const float radius = first ? a : b;
        const float other = first ? b : a;
        const float safe_radius = radius == 0.0f ? 1.0f : radius;
        const float angle = static_cast<float>(kPi / 4) * (other / safe_radius);
        const float along = radius * small_cos(angle);
        const float across = radius * small_sin(angle);
        const float disk_x = first ? along : across;
        const float disk_y = first ? across : along;
        const float height = std::sqrt(std::max(0.0f, 1.0f - disk_x * disk_x - disk_y * disk_y));
        x[j] = disk_x * tangent.x() + disk_y * bitangent.x() + height * normal.x();
        y[j] = disk_x * tangent.y() + disk_y * bitangent.y() + height * normal.y();
        z[j] = disk_x * tangent.z() + disk_y * bitangent.z() + height * normal.z();
    }
    std::fill(out.x.begin() + count_, out.x.end(), 0.0f);
    std::fill(out.y.begin() + count_, out.y.end(), 0.0f);
    std::fill(out.z.begin() + count_, out.z.end(), 0.0f);
}

}  // namespace paim
