// Bands that hold nothing are not stored.
#pragma once

#include "paim/codec/model.h"

namespace paim {

// Removes the highest bands of the transfer, and of the scenery's, as long as they are nothing but
// zeros; one is kept.
void trim_bands(Model& model);

}  // namespace paim
