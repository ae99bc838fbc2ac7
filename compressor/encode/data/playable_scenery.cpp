// The scenery of a bake as a .paim holds it.
#include "compressor/encode/data/playable_scenery.h"

#include "paim/base/check.h"

namespace paim {

Scenery playable_scenery(const BakeReader& bake, uint32_t bands) {
    if (!bake.scenery()) return {};
    const BakedScenery& baked = *bake.scenery();
    const TransferLayout& layout = bake.identity().layout;
    PAIM_CHECK_LE(bands, layout.bands);
    Scenery scenery{baked.topology, baked.albedo, baked.pose.positions, {}};
    const size_t num_vertices = baked.topology.num_vertices;
    std::vector<float> transfer;
    for (uint32_t channel = 0; channel < layout.channels; ++channel) {
        // A channel's kept planes come first.
        const auto first = baked.pose.transfer.begin() +
                           static_cast<ptrdiff_t>(layout.plane(channel, 0) * num_vertices);
        transfer.insert(transfer.end(), first,
                        first + static_cast<ptrdiff_t>(bands * bands * num_vertices));
    }
    scenery.transfer = std::move(transfer);
    return scenery;
}

}  // namespace paim
