// Reference shading on the CPU.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#include "paim/shade/shade.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

void shade(const TransferLayout& layout, std::span<const float> transfer, const Albedo& albedo,
           const LightCoefficients& light, std::vector<Vec3f>& radiance) {
    PAIM_CHECK(layout.channels == 1 || layout.channels == 3);
    PAIM_CHECK_EQ(layout.out_bands, 1u);
    PAIM_CHECK_EQ(transfer.size() % layout.num_planes(), size_t{0});
    const size_t num_vertices = transfer.size() / layout.num_planes();
    const auto num_coefficients = std::min<uint32_t>(
        layout.num_coefficients(), static_cast<uint32_t>(sh::num_coefficients(light.bands)));
    radiance.assign(num_vertices, Vec3f::Zero());
    for (uint32_t i = 0; i < num_coefficients; ++i) {
        const Vec3f& incident = light.values[i];
        if (layout.channels == 1) {
            const float* plane = transfer.data() + layout.plane(0, i) * num_vertices;
            for (size_t v = 0; v < num_vertices; ++v) radiance[v] += plane[v] * incident;
            continue;
        }
        for (uint32_t channel = 0; channel < 3; ++channel) {
            const float* plane = transfer.data() + layout.plane(channel, i) * num_vertices;
            for (size_t v = 0; v < num_vertices; ++v)
                radiance[v][channel] += plane[v] * incident[channel];
        }
    }
    for (size_t v = 0; v < num_vertices; ++v) {
        radiance[v] = radiance[v].cwiseProduct(albedo.at(static_cast<uint32_t>(v)));
    }
}

}  // namespace paim
