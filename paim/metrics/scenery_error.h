// What stands still, as a file has it, against the bake.
#pragma once

#include <string>

#include "paim/codec/model.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/geometry_error.h"
#include "paim/metrics/transfer_error.h"

namespace paim {

// The figures of an animation, of one that has a single pose.
struct SceneryError {
    TransferError transfer;  // relative to the scenery's own
    GeometryError geometry;  // its diagonal is the scenery's
};

// Bands that the model does not have count as zero; a grey model of a coloured bake counts in every
// channel.
// bake  has scenery (checked)
// Errors: bad input, naming the bake, if the model's scenery is not its.
SceneryError measure_scenery(const Model& model, const BakeReader& bake, const BandPower& spectrum);

}  // namespace paim
