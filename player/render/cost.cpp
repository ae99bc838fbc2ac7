// Counting bytes and multiply-adds.
#include "player/render/cost.h"

#include <algorithm>

namespace paim::player {

namespace {

uint64_t part_bytes(const LowRankMatrix& matrix, uint64_t planes, uint64_t num_components) {
    const uint64_t component_bytes = matrix.precision == Precision::f16 ? 2 : 4;
    const uint64_t rows = planes * matrix.num_points;
    return 4 * rows + num_components * (component_bytes * rows + 4 * uint64_t{matrix.num_poses});
}

}  // namespace

Cost frame_cost(const Model& model, const DecodeLimits& limits) {
    Cost cost{};
    cost.geometry_components = std::min(limits.geometry_components, model.geometry.num_components);
    cost.transfer_components = std::min(limits.transfer_components, model.transfer.num_components);
    cost.bands = std::min(limits.bands, model.layout.bands);
    const uint64_t coefficients = uint64_t{cost.bands} * cost.bands;
    const uint64_t planes = model.layout.channels * coefficients;
    cost.bytes = part_bytes(model.geometry, 3, cost.geometry_components) +
                 part_bytes(model.transfer, planes, cost.transfer_components);
    cost.multiply_adds = uint64_t{3} * cost.geometry_components +
                         planes * cost.transfer_components + 3 * coefficients;
    return cost;
}

}  // namespace paim::player
