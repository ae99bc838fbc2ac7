// Scenery as integers, as coarse as its errors may be.
#pragma once

#include "compressor/encode/material.h"

namespace paim {

// The scenery of the material with the largest steps that keep both errors, measured, within these;
// floats where 16 bits are too few for that.
// transfer_error  expected from the truth, of the scenery's own transfer (SceneryError), above what
//                 the bake itself has
// distance        RMS, scene units
Scenery quantise_scenery(const Material& material, double transfer_error, double distance);

}  // namespace paim
