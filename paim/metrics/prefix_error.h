// Errors of a compressed animation while it has only its first components.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/metrics/asset_error.h"
#include "paim/metrics/band_power.h"

namespace paim {

// Squared norms over all rows and poses of the decoded values x̂ of a part. Components need not be
// orthogonal.
struct ComponentEnergy {
    double decoded = 0.0;         // ‖x̂‖²
    std::vector<double> dropped;  // [1 + K] ‖x̂ − x̂_k‖², x̂_k with the first k components
};

// plane_weight [planes] of squares; planes of weight 0 cost nothing
ComponentEnergy component_energy(const CodedMesh& mesh, Attribute attribute,
                                 const std::vector<double>& plane_weight);

// Of positions, all planes alike, without exceptions (LowRank::num_usual_components()), as stated
// errors of positions are.
ComponentEnergy usual_position_energy(const CodedMesh& mesh);

// Errors with the first k components, k = 0 … K. The stated error of the whole file and the
// contribution of the missing components are assumed to be orthogonal: error² = stated² + dropped.
// Exceptions (LowRank::num_usual_components()) are in no error of positions.
struct PrefixErrors {
    std::string band_power;
    std::vector<double> transfer;      // [1 + Kt] relative to the bake's transfer
    std::vector<double> position_rms;  // [1 + Kg] scene units
    // Whether `transfer` includes the error of the whole file. Otherwise it is that of the missing
    // components alone.
    bool transfer_stated = false;
    bool position_stated = false;
};

// statement  of the file, if it has one. Its transfer errors are used if their band power is `flat`
//            or `natural`; errors under a map are ignored. Without a statement the band power is
//            `flat`.
PrefixErrors prefix_errors(const CodedMesh& mesh, const std::optional<ErrorStatement>& statement);

}  // namespace paim
