// Bands of light and of outgoing radiance that hold nothing are not stored.
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

// Whether all planes of a band of light, or of outgoing radiance, are zero in all parts.
using BandOfPlane = uint32_t (TransferLayout::*)(uint32_t plane) const;
bool band_is_zero(const Asset& asset, BandOfPlane band_of, uint32_t band) {
    for (const CodedMesh& mesh : asset.parts) {
        for (uint32_t plane = 0; plane < mesh.layout.num_planes(); ++plane) {
            if ((mesh.layout.*band_of)(plane) != band) continue;
            if (!plane_is_zero(mesh.transfer->matrix, plane)) return false;
        }
    }
    return true;
}

}  // namespace

void trim_bands(Asset& asset) {
    uint32_t in_bands = asset.moving().layout.in_bands;
    while (in_bands > 1 && band_is_zero(asset, &TransferLayout::input_band, in_bands - 1)) {
        --in_bands;
    }
    uint32_t out_bands = asset.moving().layout.out_bands;
    while (out_bands > 1 && band_is_zero(asset, &TransferLayout::output_band, out_bands - 1)) {
        --out_bands;
    }
    for (CodedMesh& mesh : asset.parts) {
        keep_bands(mesh, in_bands);
        keep_out_bands(mesh, out_bands);
    }
}

}  // namespace paim
