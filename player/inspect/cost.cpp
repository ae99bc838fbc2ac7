// Counting bytes and multiply-adds.
#include "player/inspect/cost.h"

#include <algorithm>

#include "paim/codec/frame_cost.h"

namespace paim::player {

namespace {

// Half floats are floats in memory, but not in the file.
uint64_t value_bytes(const StoredValues& values, Precision precision) {
    if (!values.holds_floats()) return values.holds_i8() ? 1 : 2;
    return precision == Precision::f16 ? 2 : 4;
}

uint64_t matrix_bytes(const LowRank& matrix, uint64_t planes, uint32_t num_components) {
    // The mean is of floats where components are half floats.
    uint64_t row_bytes = value_bytes(matrix.mean, Precision::f32);
    for (uint32_t k = 0; k < num_components; ++k) {
        row_bytes += value_bytes(matrix.components[k], matrix.precision);
    }
    return row_bytes * planes * matrix.num_points +
           (matrix.steps.empty() ? 0 : sizeof(float) * planes) +
           sizeof(float) * uint64_t{num_components} * matrix.num_poses;
}

}  // namespace

Cost frame_cost(const CodedMesh& mesh, const DecodeLimits& limits) {
    const TransferModel& transfer = *mesh.transfer;
    const TransferLayout layout = mesh.layout.with_bands(limits.bands);
    Cost cost{};
    cost.geometry_components = std::min(limits.geometry_components, mesh.positions.num_components);
    cost.transfer_components = std::min(limits.transfer_components, transfer.matrix.num_components);
    cost.vertex_components = std::min(limits.vertex_components, transfer.num_vertex_components());
    cost.bands = layout.in_bands;
    cost.bytes = matrix_bytes(mesh.positions, 3, cost.geometry_components) +
                 matrix_bytes(transfer.matrix, layout.num_planes(), cost.transfer_components) +
                 transfer.vertex_bytes(cost.vertex_components);
    const FrameCost of_transfer = transfer.cost(mesh.layout, limits, true);
    cost.multiply_adds =
        positions_cost(cost.geometry_components).per_vertex() + of_transfer.per_vertex();
    cost.cpu_multiply_adds = of_transfer.cpu_per_frame;
    return cost;
}

}  // namespace paim::player
