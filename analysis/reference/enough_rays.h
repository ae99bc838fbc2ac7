// How many rays a traced reference needs, so that its noise does not disturb the errors it judges.
#pragma once

#include "analysis/reference/traced_pictures.h"

namespace paim {

// The noise of a reference is to be below this share of an error that is measured against it.
constexpr double kNoiseOfError = 0.2;

// The largest number of rays of a vertex or pixel.
constexpr uint32_t kMostReferenceRays = 1u << 15;

// Sets the rays of a reference, so that its noise is below the share of the smallest error that is to
// be measured: that of the bake, in its first pose on the stage. Ends at kMostReferenceRays, where the
// bake is as good as that.
void take_enough_rays(const BakeReader& bake, const Stage& stage, TracedAt at,
                      TracedReference& reference);

}  // namespace paim
