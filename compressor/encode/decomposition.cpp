// Both parts of a bake as components.
#include "compressor/encode/decomposition.h"

namespace paim {

Decomposition decompose(const RowSource& geometry, const RowSource& transfer,
                        const RowSource& noise, const TransferLayout& layout,
                        uint32_t num_in_flight, const std::function<void(double)>& on_part) {
    const auto done = [&](double share) {
        if (on_part) on_part(share);
    };
    Decomposition parts;
    parts.geometry = principal_components(geometry, num_in_flight);
    parts.transfer = principal_components(transfer, num_in_flight);
    done(0.4);
    parts.noise = measure_component_noise(transfer, noise, layout, parts.transfer, num_in_flight);
    done(0.5);
    return parts;
}

}  // namespace paim
