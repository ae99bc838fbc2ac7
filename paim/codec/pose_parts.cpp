// The two halves of a decoded pose.
#include "paim/codec/pose_parts.h"

#include <algorithm>
#include <array>

#include "paim/codec/low_rank.h"

namespace paim {

void decode_positions(const Model& model, double time, const DecodeLimits& limits,
                      DecodedPose& out) {
    constexpr std::array<uint32_t, 3> kPlanes{0, 1, 2};
    std::vector<float> weights;
    interpolate_weights(model.geometry, time, weights);
    rebuild_planes(model.geometry, kPlanes, weights,
                   std::min(limits.geometry_components, model.geometry.num_components),
                   out.positions);
}

void decode_transfer_points(const Model& model, double time, const DecodeLimits& limits,
                            TransferLayout& layout, std::vector<float>& out) {
    layout = model.layout;
    layout.bands = std::clamp(limits.bands, 1u, model.layout.bands);
    std::vector<uint32_t> planes;
    for (uint32_t channel = 0; channel < layout.channels; ++channel) {
        for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
            planes.push_back(model.layout.plane(channel, i));
        }
    }
    std::vector<float> weights;
    interpolate_weights(model.transfer, time, weights);
    rebuild_planes(model.transfer, planes, weights,
                   std::min(limits.transfer_components, model.transfer.num_components), out);
}

}  // namespace paim
