// Bands of light and of outgoing radiance that hold nothing are not stored.
#pragma once

#include "paim/codec/asset.h"

namespace paim {

// Removes the highest bands of light, and of outgoing radiance, as long as the transfer is zero there in
// all parts; one of each is kept.
void trim_bands(Asset& asset);

}  // namespace paim
