// Removes bands and components of coded data.
#include "paim/codec/cut.h"

#include <algorithm>
#include <vector>

namespace paim {

namespace {

StoredValues keep_planes(const StoredValues& values, const std::vector<uint32_t>& planes,
                         size_t num_points) {
    return std::visit(
        [&](const auto& all) {
            std::decay_t<decltype(all)> kept;
            kept.reserve(planes.size() * num_points);
            for (const uint32_t plane : planes) {
                const auto first = all.begin() + static_cast<ptrdiff_t>(plane * num_points);
                kept.insert(kept.end(), first, first + static_cast<ptrdiff_t>(num_points));
            }
            return StoredValues(std::move(kept));
        },
        values.values());
}

// layout  the same with fewer bands
void keep_layout(const TransferLayout& layout, TransferLayout& whole, LowRank& matrix) {
    if (layout == whole) return;
    std::vector<uint32_t> planes;
    planes_of(whole, layout, planes);
    matrix.mean = keep_planes(matrix.mean, planes, matrix.num_points);
    for (StoredValues& component : matrix.components) {
        component = keep_planes(component, planes, matrix.num_points);
    }
    if (!matrix.steps.empty()) {
        std::vector<float> steps;
        for (const uint32_t plane : planes) steps.push_back(matrix.steps[plane]);
        matrix.steps = std::move(steps);
    }
    matrix.num_planes = layout.num_planes();
    whole = layout;
}

}  // namespace

void keep_bands(CodedMesh& mesh, uint32_t bands) {
    keep_layout(mesh.layout.with_bands(bands), mesh.layout, mesh.transfer->matrix);
    if (!mesh.gloss) return;
    CodedGloss& gloss = *mesh.gloss;
    keep_layout(gloss.layout.with_bands(bands), gloss.layout, gloss.transfer->matrix);
}

void keep_out_bands(CodedMesh& mesh, uint32_t bands) {
    TransferLayout layout = mesh.layout;
    layout.out_bands = std::min(std::max(bands, 1u), layout.out_bands);
    keep_layout(layout, mesh.layout, mesh.transfer->matrix);
}

void keep_within(const DecodeLimits& limits, Asset& asset) {
    for (CodedMesh& mesh : asset.parts) {
        keep_bands(mesh, limits.bands);
        mesh.positions.keep_components(limits.geometry_components);
        mesh.transfer->matrix.keep_components(limits.transfer_components);
        if (mesh.gloss) mesh.gloss->transfer->matrix.keep_components(limits.gloss_components);
    }
}

}  // namespace paim
