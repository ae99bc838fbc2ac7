// Cosine-distributed directions on a spiral. Projecting the disk onto the hemisphere gives cosine
// density (Malley).
#include "compressor/bake/cosine_directions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/orthonormal_basis.h"

namespace paim {

namespace {

constexpr double kTurnsPerPoint = 1.0 / std::numbers::sqrt2;

// Vector registers of SSE2 and NEON. GCC and Clang do arithmetic on these types directly.
constexpr size_t kLanes = 4;
using Floats = float __attribute__((vector_size(16)));

inline Floats load(const float* from) {
    Floats lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

inline Floats square_root(Floats x) {
    for (size_t lane = 0; lane < kLanes; ++lane) x[lane] = std::sqrt(x[lane]);
    return x;
}

struct DiskPoint {
    double x, y;
    uint32_t j;
};

// Puts points in an order in which each sixteen are close together: halves them across the longer
// side of what they cover, again and again, between multiples of sixteen.
void sort_by_place(std::span<DiskPoint> points) {
    constexpr size_t kPacket = 16;
    if (points.size() <= kPacket) return;
    const auto [left, right] = std::ranges::minmax(points, {}, &DiskPoint::x);
    const auto [bottom, top] = std::ranges::minmax(points, {}, &DiskPoint::y);
    const bool is_wide = right.x - left.x > top.y - bottom.y;
    const size_t half = (points.size() / 2 + kPacket - 1) / kPacket * kPacket;
    std::ranges::nth_element(
        points, points.begin() + static_cast<std::ptrdiff_t>(half), {},
        [&](const DiskPoint& p) { return std::pair(is_wide ? p.x : p.y, p.j); });
    sort_by_place(points.first(half));
    sort_by_place(points.subspan(half));
}

}  // namespace

CosineDirections::CosineDirections(uint32_t num_points, uint32_t num_parts)
    : num_points_(num_points), count_(num_points / num_parts), parts_(num_parts) {
    PAIM_CHECK(num_parts == 1 || num_parts == 2);
    PAIM_CHECK_EQ(num_points % num_parts, 0u);
    const auto angle = [](uint32_t j) {
        const double turns = j * kTurnsPerPoint;
        return 2.0 * kPi * (turns - std::floor(turns));
    };
    std::vector<std::vector<DiskPoint>> points(num_parts);
    for (uint32_t j = 0; j < num_points; ++j) {
        const double radius = std::sqrt((j + 0.5) / num_points);
        points[j % num_parts].push_back(
            {radius * std::cos(angle(j)), radius * std::sin(angle(j)), j});
    }
    for (size_t h = 0; h < num_parts; ++h) {
        sort_by_place(points[h]);
        Part& part = parts_[h];
        for (auto* array : {&part.ring, &part.cosine, &part.sine}) {
            array->resize(DirectionArrays::padded(count_), 0.0f);
        }
        for (size_t k = 0; k < count_; ++k) {
            const uint32_t j = points[h][k].j;
            part.ring[k] = static_cast<float>(static_cast<double>(j) / num_points);
            part.cosine[k] = static_cast<float>(std::cos(angle(j)));
            part.sine[k] = static_cast<float>(std::sin(angle(j)));
        }
    }
}

void CosineDirections::generate(const Vec3f& normal, uint64_t key, uint32_t part,
                                DirectionArrays& out) const {
    // Bits 0, 8 … 31 and 40 … 63 of the key; 24 bits are exact in float.
    const float shift = static_cast<float>(static_cast<uint32_t>(key) >> 8) * 0x1.0p-24f /
                        static_cast<float>(num_points_);
    const double turn = 2.0 * kPi * static_cast<double>(key >> 40) * 0x1.0p-24;
    const Part& points = parts_[parts_.size() == 2 ? part ^ (key & 1u) : part];
    const auto cos_turn = static_cast<float>(std::cos(turn));
    const auto sin_turn = static_cast<float>(std::sin(turn));
    Vec3f tangent, bitangent;
    orthonormal_basis(normal, tangent, bitangent);
    const Vec3f u = cos_turn * tangent + sin_turn * bitangent;
    const Vec3f v = cos_turn * bitangent - sin_turn * tangent;
    const Vec3f n = normal;  // a copy: the compiler knows that the stores below do not change it
    const size_t padded = points.ring.size();
    out.x.resize(padded);
    out.y.resize(padded);
    out.z.resize(padded);
    float* const to[3] = {out.x.data(), out.y.data(), out.z.data()};
    for (size_t k = 0; k < padded; k += kLanes) {
        const Floats radius2 = load(points.ring.data() + k) + shift;
        const Floats radius = square_root(radius2);
        const Floats height2 = 1.0f - radius2;
        const Floats height = square_root(height2 > 0.0f ? height2 : Floats{});
        const Floats along = radius * load(points.cosine.data() + k);
        const Floats across = radius * load(points.sine.data() + k);
        for (int axis = 0; axis < 3; ++axis) {
            const Floats w = along * u[axis] + across * v[axis] + height * n[axis];
            std::memcpy(to[axis] + k, &w, sizeof w);
        }
    }
    std::fill(out.x.begin() + count_, out.x.end(), 0.0f);
    std::fill(out.y.begin() + count_, out.y.end(), 0.0f);
    std::fill(out.z.begin() + count_, out.z.end(), 0.0f);
}

}  // namespace paim
