// The still part as integers, as coarse as its errors may be.
#pragma once

#include <optional>

#include "compressor/encode/search/problem.h"
#include "compressor/encode/search/targets.h"

namespace paim {

// Nothing if the bake has no still meshes.
struct QuantisedStill {
    std::optional<CodedMesh> mesh;
    std::optional<MeshError> error;  // measured
};

// The still part of the problem with about the largest steps that keep all errors, measured, within
// the targets; floats where no steps of 16 bits do.
// targets  the transfer error is that of the part's own transfer, and above the error of the bake
QuantisedStill quantise_still(const EncodeProblem& problem, const Targets& targets);

// Floats, as they were baked.
QuantisedStill exact_still(const EncodeProblem& problem);

}  // namespace paim
