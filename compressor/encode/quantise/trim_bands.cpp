// Bands that hold nothing are not stored.
#include "compressor/encode/quantise/trim_bands.h"

#include <algorithm>

#include "paim/codec/cut.h"

namespace paim {

namespace {

bool all_zero(const StoredValues& values, size_t first, size_t count) {
    bool zero = true;
    values.for_each(first, count, [&](size_t, float value) { zero = zero && value == 0.0f; });
    return zero;
}

bool plane_is_zero(const LowRank& matrix, uint32_t plane) {
    const size_t first = size_t{plane} * matrix.num_points;
    if (!all_zero(matrix.mean, first, matrix.num_points)) return false;
    for (const StoredValues& component : matrix.components) {
        if (!all_zero(component, first, matrix.num_points)) return false;
    }
    return true;
}

bool band_is_zero(const LowRank& matrix, const TransferLayout& layout, uint32_t band) {
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        if (layout.input_band(plane) == band && !plane_is_zero(matrix, plane)) return false;
    }
    return true;
}

}  // namespace

void trim_bands(Asset& asset) {
    uint32_t bands = asset.moving().layout.in_bands;
    const auto is_zero = [&](const CodedMesh& mesh) {
        return band_is_zero(mesh.transfer->matrix, mesh.layout, bands - 1);
    };
    while (bands > 1 && std::all_of(asset.parts.begin(), asset.parts.end(), is_zero)) --bands;
    for (CodedMesh& mesh : asset.parts) keep_bands(mesh, bands);
}

}  // namespace paim
