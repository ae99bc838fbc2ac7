// A compressed animation with its first components only.
#pragma once

#include "paim/codec/asset.h"

namespace paim {

inline Asset first_components(Asset asset, uint32_t num_geometry, uint32_t num_transfer) {
    asset.moving().positions.keep_components(num_geometry);
    asset.moving().transfer->matrix.keep_components(num_transfer);
    return asset;
}

}  // namespace paim
