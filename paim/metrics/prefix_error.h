// What a compressed animation costs in accuracy while it has only its first components.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// Squared norms over all rows and poses of what a part decodes to. Components need not be
// orthogonal.
struct ComponentEnergy {
    double decoded = 0.0;         // ‖t̂‖², or that of positions
    std::vector<double> dropped;  // [1 + K] ‖t̂ − t̂_k‖², t̂_k with the first k components
};

// plane_weight [planes] of squares
ComponentEnergy component_energy(const CodedMesh& mesh, Attribute attribute,
                                 const std::vector<double>& plane_weight);

// Errors with the first k components, k = 0 … K. What is stated of the whole file and what the
// missing components take away are taken for orthogonal: errors² = stated² + dropped.
struct PrefixErrors {
    std::string band_power;
    std::vector<double> transfer;      // [1 + Kt] relative to the bake's transfer
    std::vector<double> position_rms;  // [1 + Kg] scene units
    // Whether the error of the whole file is part of it; else it is what the missing components cost.
    bool transfer_stated = false;
    bool position_stated = false;
};

// statement  of the model's file, if there is one. Its transfer counts under the light spectra that
//            have names; errors under a map are taken for not stated. Not stated: `flat`.
PrefixErrors prefix_errors(const CodedMesh& mesh, const std::optional<ErrorStatement>& statement);

}  // namespace paim
