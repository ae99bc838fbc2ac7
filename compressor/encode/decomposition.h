// Both parts of a bake as components, whatever is kept of them.
#pragma once

#include <cstdint>
#include <functional>

#include "compressor/encode/data/row_source.h"
#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/svd/principal_components.h"

namespace paim {

struct Decomposition {
    PrincipalComponents geometry, transfer;
    ComponentNoise noise;  // in the components of the transfer
};

// Reads all rows of the geometry once, those of the transfer twice, and those of its noise once.
// layout         of the rows of transfer and noise
// num_in_flight  as of principal_components()
// on_part        called with a share of what was left to be done, after each part
Decomposition decompose(const RowSource& geometry, const RowSource& transfer,
                        const RowSource& noise, const TransferLayout& layout,
                        uint32_t num_in_flight, const std::function<void(double)>& on_part = {});

}  // namespace paim
