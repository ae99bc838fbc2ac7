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

// Makes steps finer until all errors, measured, are within the targets, and coarser where there is
// room: first those of the positions, then those of the transfer. Nothing if no step was found.
// still  of these targets
std::optional<RefinedAsset> refine(const EncodeProblem& problem, const QuantisedStill& still,
                                   Coding coding, const Targets& targets);

// Steps that should do for other targets, where those of `from` were met.
void scale_steps(const EncodeProblem& problem, const Targets& from, const Targets& to,
                 Coding& coding);

}  // namespace paim
