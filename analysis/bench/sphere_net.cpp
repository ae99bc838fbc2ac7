// Diffuse transfer as pbrt-v2 computes it.
#include "analysis/bench/sphere_net.h"

#include <cmath>

#include "compressor/bake/sobol.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/sh/basis.h"

namespace paim::bench {

namespace {

// Of reversed digits and a shift.
float shifted_fraction(uint32_t reversed, uint32_t shift) {
    return static_cast<float>((reverse_bits(reversed) ^ shift) >> 8) * 0x1.0p-24f;
}

Vec3f on_sphere(float u, float v) {
    const float z = 1.0f - 2.0f * u;
    const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float angle = static_cast<float>(2.0 * kPi) * v;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

std::vector<float> sphere_net_transfer(const BareScene& scene, std::span<const Vec3f> origins,
                                       std::span<const Vec3f> normals, const SphereNet& net,
                                       size_t origins_per_piece) {
    const size_t num_planes = size_t{net.bands} * net.bands;
    const SobolPoints points(net.num_points);
    std::vector<float> transfer(num_planes * origins.size());
    parallel_for(origins.size(), origins_per_piece, [&](size_t begin, size_t end) {
        std::vector<float> basis(num_planes), sums(num_planes);
        for (size_t v = begin; v < end; ++v) {
            const uint64_t shift = stream_key(net.seed, 0, v);
            std::fill(sums.begin(), sums.end(), 0.0f);
            for (uint32_t j = 0; j < net.num_points; ++j) {
                const Vec3f direction = on_sphere(
                    shifted_fraction(points.reversed_x[j], static_cast<uint32_t>(shift)),
                    shifted_fraction(points.reversed_y[j], static_cast<uint32_t>(shift >> 32)));
                const float cosine = direction.dot(normals[v]);
                if (!(cosine > 0.0f) || scene.is_blocked(origins[v], direction)) continue;
                sh::evaluate_basis(static_cast<int>(net.bands), direction.cast<double>(),
                                   std::span(basis));
                for (size_t i = 0; i < num_planes; ++i) sums[i] += cosine * basis[i];
            }
            // Density 1/4π, and transfer is 1/π of the integral.
            const float scale = 4.0f / static_cast<float>(net.num_points);
            for (size_t i = 0; i < num_planes; ++i) {
                transfer[i * origins.size() + v] = scale * sums[i];
            }
        }
    });
    return transfer;
}

}  // namespace paim::bench
