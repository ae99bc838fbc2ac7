// Steps that meet a target, measured.
#pragma once

#include <optional>

#include "compressor/encode/search/quantise_still.h"
#include "compressor/encode/search/settings_search.h"

namespace paim {

struct RefinedAsset {
    Asset asset;
    AssetError error;  // measured
    Coding coding;     // with the steps that it was made with
};

// Makes the steps of the transfer finer until all errors, measured, are within the targets, and
// coarser where there is room. Nothing if no step was found.
// still, positions  that meet these targets; the positions take the place of the coding's
std::optional<RefinedAsset> refine(const EncodeProblem& problem, const QuantisedStill& still,
                                   const RefinedPositions& positions, Coding coding,
                                   const Targets& targets);

// Steps that should do for other targets, where those of `from` were met.
void scale_steps(const EncodeProblem& problem, const Targets& from, const Targets& to,
                 Coding& coding);

}  // namespace paim
