// Scenery as integers, as coarse as its errors may be.
#pragma once

#include <optional>

#include "compressor/encode/search/problem.h"

namespace paim {

struct QuantisedScenery {
    Scenery scenery;
    std::optional<SceneryError> error;  // measured; none of no scenery
};

// The scenery of the problem with the largest steps that keep both errors, measured, within these;
// floats where no steps of 16 bits do.
// transfer_error  expected from the truth, of the scenery's own transfer (SceneryError), above what
//                 the bake itself has
// distance        RMS, scene units
QuantisedScenery quantise_scenery(const EncodeProblem& problem, double transfer_error,
                                  double distance);

// As it is.
QuantisedScenery exact_scenery(const EncodeProblem& problem);

}  // namespace paim
