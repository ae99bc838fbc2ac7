// The scenery of a bake as a .paim holds it.
#pragma once

#include "paim/codec/model.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Its transfer's first bands; empty if the bake has no scenery.
// bands  1 … the bake's
Scenery playable_scenery(const BakeReader& bake, uint32_t bands);

}  // namespace paim
