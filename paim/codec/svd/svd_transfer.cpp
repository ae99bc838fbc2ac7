// Codec svd: M + U·W, plane by plane.
// Based on: Cardoso and Kry 2012 (see the header)
#include "paim/codec/svd/svd_transfer.h"

#include <algorithm>

namespace paim {

std::unique_ptr<TransferModel> SvdTransfer::clone() const {
    return std::make_unique<SvdTransfer>(*this);
}

FrameCost SvdTransfer::cost(const TransferLayout& layout, const DecodeLimits& limits,
                            bool coloured_light) const {
    return svd_cost(layout.with_bands(limits.bands),
                    std::min(limits.transfer_components, matrix.num_components), coloured_light);
}

FrameCost svd_cost(const TransferLayout& layout, uint32_t num_components, bool coloured_light) {
    const uint64_t channels = num_radiance_channels(layout, coloured_light);
    return {(uint64_t{num_components} + 1) * layout.num_planes(),
            channels * layout.num_outgoing() * layout.num_coefficients(), 0};
}

}  // namespace paim
