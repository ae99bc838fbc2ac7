// Reference shading on the CPU.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#include "paim/shade/shade.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

namespace {

// Adds plane times incident radiance to the channels that the plane is of.
void add_plane(const TransferLayout& layout, uint32_t channel, const float* plane,
               const Vec3f& incident, std::span<Vec3f> radiance) {
    if (layout.channels == 1) {
        for (size_t v = 0; v < radiance.size(); ++v) radiance[v] += plane[v] * incident;
        return;
    }
    for (size_t v = 0; v < radiance.size(); ++v) {
        radiance[v][channel] += plane[v] * incident[channel];
    }
}

}  // namespace

void shade(const TransferLayout& layout, std::span<const float> transfer, const Albedo& albedo,
           const LightCoefficients& light, std::vector<Vec3f>& radiance) {
    PAIM_CHECK(layout.channels == 1 || layout.channels == 3);
    PAIM_CHECK_EQ(transfer.size() % layout.num_planes(), size_t{0});
    const size_t num_vertices = transfer.size() / layout.num_planes();
    const auto num_coefficients = std::min<uint32_t>(
        layout.num_coefficients(), static_cast<uint32_t>(sh::num_coefficients(light.bands)));
    radiance.assign(layout.num_outgoing() * num_vertices, Vec3f::Zero());
    for (uint32_t o = 0; o < layout.num_outgoing(); ++o) {
        const std::span out = std::span(radiance).subspan(o * num_vertices, num_vertices);
        for (uint32_t i = 0; i < num_coefficients; ++i) {
            for (uint32_t channel = 0; channel < layout.channels; ++channel) {
                const size_t first = layout.plane(channel, i, o) * num_vertices;
                add_plane(layout, channel, transfer.data() + first, light.values[i], out);
            }
        }
        for (size_t v = 0; v < num_vertices; ++v) {
            out[v] = out[v].cwiseProduct(albedo.at(static_cast<uint32_t>(v)));
        }
    }
}

}  // namespace paim
