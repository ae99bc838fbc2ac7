// The inner loops of decoding, one version for each vector unit.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "paim/codec/stored_values.h"
#include "paim/codec/vector_unit.h"

namespace paim {

// Components that are added at once, so that sums stay in registers. With their weights they fill
// the 16 registers of AVX2.
constexpr size_t kMaxColumns = 8;
// Planes of a row, and vertices, that are summed at once.
constexpr int kNarrowTile = 4;
constexpr int kWideTile = 16;
constexpr int kWidestTile = 32;
constexpr size_t kVertices = 64;
constexpr size_t kLineBytes = 64;

// Distance at which values are prefetched. The processor's own prefetching takes a while to
// recognise each of so many streams.
constexpr size_t kAheadBytes = 1024;

// A number of magnitude below 2^22 plus this has the nearest integer, ties to even, in its lowest
// bits.
constexpr float kRoundToInteger = 0x1.8p23f;

// Prefetches; the address may lie past the values, because nothing is read there.
__attribute__((always_inline)) inline void fetch_ahead(const void* from, size_t offset_bytes) {
    __builtin_prefetch(
        reinterpret_cast<const void*>(std::bit_cast<uintptr_t>(from) + offset_bytes + kAheadBytes));
}

// Values of some components (or coefficients), of one type.
struct Columns {
    enum class Type { f32, i16, i8 };

    Type type = Type::f32;
    size_t count = 0;
    std::array<const void*, kMaxColumns> values{};
};

// Some rows to add to each of some vertices, for one tile of planes.
struct RowBlock {
    size_t count = 0;                          // of vertices
    size_t first_row = 0;                      // relative to rows[v]; 1 starts a sum
    size_t num_rows = 0;                       // at most kMaxColumns
    size_t stride = 0;                         // from row to row
    std::array<const float*, kVertices> rows;  // row 0 of each vertex, from the tile's first plane
    std::array<std::array<float, kVertices>, kMaxColumns> coefficients;  // [row][vertex]
};

// Planes that are smoothed at once. A row has the value of each of them at a vertex.
constexpr size_t kSmoothedPlanes = 32;

// A round of smoothing (surface_smoothing.h) of rows.
struct SmoothingRound {
    const uint32_t* first = nullptr;       // [V + 1] into neighbours
    const uint32_t* neighbours = nullptr;  // of all vertices
    const uint32_t* order = nullptr;       // [V] in which vertices are visited
    const float* before = nullptr;         // [V][kSmoothedPlanes], nearer to integers than 1/2
    float* after = nullptr;                // [V][kSmoothedPlanes]
    float reach = 0.0f;                    // from these integers
    std::array<int32_t, kSmoothedPlanes> active{};  // −1: the plane is smoothed, 0: it stays
};

struct VectorKernels {
    // to[j] = from[j]
    void (*widen)(Columns::Type type, const void* from, float* to, size_t count);
    // to[j] += Σ_k weights[k] · columns[k][j], in order of k
    void (*add)(const Columns& columns, const float* weights, float* to, size_t count);
    // values[j] *= factor
    void (*scale)(float factor, float* values, size_t count);
    // sums[v][i] += Σ_j coefficients[j][v] · row(v, first_row + j)[i] for the planes i of a tile,
    // in order of j. With first_row = 1 sums start from row(v, 0)[i] instead of their old values.
    void (*sum_narrow)(const RowBlock& block, float* sums);
    void (*sum_wide)(const RowBlock& block, float* sums);
    void (*sum_widest)(const RowBlock& block, float* sums);
    // Vertices [begin, end) of the order of a round.
    void (*smooth)(const SmoothingRound& round, size_t begin, size_t end);
};

// The kernels of a unit that the machine has. `plain` has none (checked).
const VectorKernels& vector_kernels(VectorUnit unit);

Columns::Type type_of(const StoredValues& stored);
const void* values_from(const StoredValues& stored, size_t first);

// The components from number k on that can be added at once: all have one type. Values begin at
// number `first` of theirs.
Columns columns_from(std::span<const StoredValues> components, size_t k, size_t first);

}  // namespace paim
