// Sums of weighted rows of clusters' bases.
#include "paim/codec/cpca/basis_table.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/vector_kernels.h"

namespace paim {

namespace {

float sum_plain(const BasisSum& combination, size_t v, size_t plane) {
    const BasisTable& table = combination.table;
    const float* row =
        table.values.data() + plane +
        size_t{combination.cluster[v]} * combination.rows_per_cluster * table.padded_planes;
    float value = *row;
    for (const StoredValues& coefficients : combination.coefficients) {
        row += table.padded_planes;
        value += coefficients[v] * *row;
    }
    return value;
}

// out[i · stride + v] = sums[v][i] for the first num_planes of W planes.
template <int W>
void store_planes(const float* sums, size_t count, size_t num_planes, size_t stride, float* out) {
    size_t v = 0;
#if defined(__x86_64__)
    for (; v + 4 <= count; v += 4) {
        for (size_t i = 0; i < num_planes; i += 4) {
            const float* from = sums + v * W + i;
            __m128 a = _mm_loadu_ps(from), b = _mm_loadu_ps(from + W),
                   c = _mm_loadu_ps(from + 2 * W), d = _mm_loadu_ps(from + 3 * W);
            _MM_TRANSPOSE4_PS(a, b, c, d);
            float* to = out + i * stride + v;
            _mm_storeu_ps(to, a);
            if (i + 1 < num_planes) _mm_storeu_ps(to + stride, b);
            if (i + 2 < num_planes) _mm_storeu_ps(to + 2 * stride, c);
            if (i + 3 < num_planes) _mm_storeu_ps(to + 3 * stride, d);
        }
    }
#endif
    for (; v < count; ++v) {
        for (size_t i = 0; i < num_planes; ++i) out[i * stride + v] = sums[v * W + i];
    }
}

// Planes [plane, plane + W) of at most kVertices vertices; there may be fewer planes.
template <int W>
void store_tile(const BasisSum& combination, size_t first, size_t count, size_t plane,
                void (*add_rows)(const RowBlock&, float*), const VectorKernels& use, float* out) {
    const BasisTable& table = combination.table;
    RowBlock block;
    block.count = count;
    block.stride = table.padded_planes;
    const float* const rows = table.values.data() + plane;
    const uint32_t* const cluster = combination.cluster.data() + first;
    const size_t floats_per_cluster = combination.rows_per_cluster * block.stride;
    for (size_t b = 0; b < count * sizeof(*cluster); b += kLineBytes) fetch_ahead(cluster, b);
    for (size_t v = 0; v < count; ++v) block.rows[v] = rows + cluster[v] * floats_per_cluster;
    const std::span<const StoredValues> coefficients = combination.coefficients;
    std::array<float, kVertices * W> sums;
    size_t j = 0;
    do {
        block.first_row = 1 + j;
        block.num_rows = std::min(kMaxColumns, coefficients.size() - j);
        for (size_t i = 0; i < block.num_rows; ++i, ++j) {
            use.widen(type_of(coefficients[j]), values_from(coefficients[j], first),
                      block.coefficients[i].data(), count);
        }
        add_rows(block, sums.data());
    } while (j < coefficients.size());
    const size_t num_vertices = combination.cluster.size();
    store_planes<W>(sums.data(), count, std::min<size_t>(W, table.num_planes - plane), num_vertices,
                    out + plane * num_vertices + first);
}

void check(const BasisSum& combination, size_t first, size_t count) {
    const size_t num_vertices = combination.cluster.size();
    PAIM_CHECK(first <= num_vertices && count <= num_vertices - first);
    PAIM_CHECK(combination.coefficients.size() < combination.rows_per_cluster);
    for (const StoredValues& coefficients : combination.coefficients) {
        PAIM_CHECK_EQ(coefficients.size(), num_vertices);
    }
}

}  // namespace

void BasisTable::assign(std::span<const float> rows, std::span<const float> scales) {
    const size_t num_rows = scales.size();
    PAIM_CHECK(num_rows > 0);
    num_planes = static_cast<uint32_t>(rows.size() / num_rows);
    PAIM_CHECK_EQ(size_t{num_planes} * num_rows, rows.size());
    const uint32_t tile = num_planes <= kNarrowTile ? kNarrowTile : kWideTile;
    padded_planes = (num_planes + tile - 1) / tile * tile;
    values.resize(num_rows * padded_planes);
    for (size_t r = 0; r < num_rows; ++r) {
        float* to = values.data() + r * padded_planes;
        for (size_t i = 0; i < num_planes; ++i) to[i] = scales[r] * rows[i * num_rows + r];
        std::fill(to + num_planes, to + padded_planes, 0.0f);
    }
}

void weighted_sum(const BasisSum& combination, size_t first, size_t count, std::span<float> out,
                  VectorUnit unit) {
    const BasisTable& table = combination.table;
    check(combination, first, count);
    PAIM_CHECK_EQ(out.size(), table.num_planes * combination.cluster.size());
    if (unit == VectorUnit::plain) {
        for (size_t plane = 0; plane < table.num_planes; ++plane) {
            for (size_t v = first; v < first + count; ++v) {
                out[plane * combination.cluster.size() + v] = sum_plain(combination, v, plane);
            }
        }
        return;
    }
    const VectorKernels& use = vector_kernels(unit);
    for (size_t v = first; v < first + count; v += kVertices) {
        const size_t some = std::min(kVertices, first + count - v);
        if (table.padded_planes == kNarrowTile) {
            store_tile<kNarrowTile>(combination, v, some, 0, use.sum_narrow, use, out.data());
            continue;
        }
        size_t plane = 0;
        for (; plane + kWidestTile <= table.padded_planes; plane += kWidestTile) {
            store_tile<kWidestTile>(combination, v, some, plane, use.sum_widest, use, out.data());
        }
        if (plane < table.padded_planes) {
            store_tile<kWideTile>(combination, v, some, plane, use.sum_wide, use, out.data());
        }
    }
}

void sum_all(const VertexClusters& clusters, const BasisTable& table, uint32_t num_components,
             std::span<float> out) {
    constexpr size_t kVerticesATask = 1024;
    const BasisSum sum{table, clusters.cluster,
                       std::span(clusters.coefficients).first(num_components),
                       clusters.rows_per_cluster()};
    parallel_for(clusters.cluster.size(), kVerticesATask,
                 [&](size_t begin, size_t end) { weighted_sum(sum, begin, end - begin, out); });
}

}  // namespace paim
