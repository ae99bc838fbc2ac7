// Bands that hold nothing are not stored.
#pragma once

#include "paim/codec/asset.h"

namespace paim {

// Removes the highest bands of the transfer as long as they are zero in all parts; one is kept.
void trim_bands(Asset& asset);

}  // namespace paim
