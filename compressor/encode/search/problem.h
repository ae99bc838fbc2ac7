// Everything about a bake that ways to code it are compared on.
#pragma once

#include <algorithm>
#include <vector>

#include "compressor/encode/options.h"
#include "compressor/encode/quantise/scaled_factors.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/mesh/cache_order.h"
#include "paim/metrics/model_error.h"

namespace paim {

struct EncodeProblem {
    const BakeReader& bake;
    TransferLayout layout;  // bands as asked for
    BandPower spectrum;
    PoseStatistics statistics;
    Model frame;  // all but geometry and transfer; vertices in local order
    PlanePredictor predictor;
    ScaledFactors geometry, transfer;  // as many components as can matter; noise taken out
    std::vector<double> plane_weight;  // [planes of layout] of squared transfer errors
    ModelError floor;                  // of these components, not quantised: the best there is
    double transfer_energy = 0.0;      // weighted ‖y‖² of the whole bake
    uint64_t spare_bytes = 0;          // of options.memory_bytes, beside what is held throughout
    uint64_t unneeded_bytes = 0;       // of these, beside all that can be needed

    ModelError measure(const Model& model) const { return measure_model(model, bake, spectrum); }

    // What noise and bands of the bake leave of the transfer error at best, scenery included.
    double least_error() const {
        const double still = floor.scenery ? floor.scenery->transfer.total() : 0.0;
        return std::max(floor.transfer.total(), still);
    }
};

// Errors: unsupported, saying what is needed, if options.memory_bytes do not suffice for all that
// encode_to_target() does.
EncodeProblem read_problem(const BakeReader& bake, const EncodeOptions& options,
                           const EncodeTarget& target);

}  // namespace paim
