// The still part as integers, as coarse as its errors may be.
#pragma once

#include <optional>

#include "compressor/encode/search/problem.h"

namespace paim {

// Nothing if the bake has no still meshes.
struct QuantisedStill {
    std::optional<CodedMesh> mesh;
    std::optional<MeshError> error;  // measured
};

// The still part of the problem with the largest steps that keep both errors, measured, within
// these; floats where no steps of 16 bits do.
// transfer_error  expected from the truth, of the part's own transfer, above the error of the bake itself
// distance        RMS, scene units
QuantisedStill quantise_still(const EncodeProblem& problem, double transfer_error, double distance);

// Floats, as they were baked.
QuantisedStill exact_still(const EncodeProblem& problem);

}  // namespace paim
