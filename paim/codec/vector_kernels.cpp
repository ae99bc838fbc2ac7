// The inner loops of decoding, one version for each vector unit.
#include "paim/codec/vector_kernels.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "paim/base/check.h"

namespace paim {

namespace {

using Type = Columns::Type;

typedef float FourFloats __attribute__((vector_size(16)));

// The portable vector: the smallest one that divides a tile.
struct OneFour {
    using TileVector = FourFloats;
    static constexpr size_t kFours = 1;
    __attribute__((always_inline)) static FourFloats load_fours(const float* const* rows,
                                                                size_t offset) {
        FourFloats values;
        __builtin_memcpy(&values, rows[0] + offset, sizeof(values));
        return values;
    }
    __attribute__((always_inline)) static FourFloats spread(const float* values) {
        return FourFloats{values[0], values[0], values[0], values[0]};
    }
};

namespace portable {

#define PAIM_TARGET
#define PAIM_TARGET_INLINE __attribute__((always_inline)) inline
struct Lanes : OneFour {
    using Vector = float;
    static constexpr size_t kLanes = 1;
    template <typename T>
    static float load(const T* values) {
        return static_cast<float>(*values);
    }
};
#include "paim/codec/vector_kernels.inc"
#undef PAIM_TARGET
#undef PAIM_TARGET_INLINE

}  // namespace portable

#if defined(__x86_64__)

namespace avx2 {

#define PAIM_TARGET __attribute__((target("avx2")))
#define PAIM_TARGET_INLINE __attribute__((target("avx2"), always_inline)) inline
struct Lanes {
    using Vector = __m256;
    using TileVector = __m256;
    static constexpr size_t kLanes = 8;
    PAIM_TARGET_INLINE static Vector load(const float* values) { return _mm256_loadu_ps(values); }
    PAIM_TARGET_INLINE static Vector load(const int16_t* values) {
        const __m128i narrow = _mm_loadu_si128(reinterpret_cast<const __m128i*>(values));
        return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(narrow));
    }
    PAIM_TARGET_INLINE static Vector load(const int8_t* values) {
        const __m128i narrow = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(values));
        return _mm256_cvtepi32_ps(_mm256_cvtepi8_epi32(narrow));
    }
    static constexpr size_t kFours = 2;
    PAIM_TARGET_INLINE static Vector load_fours(const float* const* rows, size_t offset) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(rows[0] + offset)),
                                    _mm_loadu_ps(rows[1] + offset), 1);
    }
    PAIM_TARGET_INLINE static Vector spread(const float* values) {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_broadcast_ss(values)),
                                    _mm_broadcast_ss(values + 1), 1);
    }
};
#include "paim/codec/vector_kernels.inc"
#undef PAIM_TARGET
#undef PAIM_TARGET_INLINE

}  // namespace avx2

namespace avx512 {

#define PAIM_TARGET __attribute__((target("avx512f")))
#define PAIM_TARGET_INLINE __attribute__((target("avx512f"), always_inline)) inline
struct Lanes {
    using Vector = __m512;
    using TileVector = __m512;
    static constexpr size_t kLanes = 16;
    // The masked functions with all lanes set cost nothing. GCC 12 warns about uninitialised values
    // in its own header for the functions without a mask.
    static constexpr __mmask16 kAll = 0xffff;
    PAIM_TARGET_INLINE static Vector to_floats(const __m512i& values) {
        return _mm512_maskz_cvtepi32_ps(kAll, values);
    }
    PAIM_TARGET_INLINE static Vector load(const float* values) { return _mm512_loadu_ps(values); }
    PAIM_TARGET_INLINE static Vector load(const int16_t* values) {
        const __m256i narrow = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(values));
        return to_floats(_mm512_maskz_cvtepi16_epi32(kAll, narrow));
    }
    PAIM_TARGET_INLINE static Vector load(const int8_t* values) {
        const __m128i narrow = _mm_loadu_si128(reinterpret_cast<const __m128i*>(values));
        return to_floats(_mm512_maskz_cvtepi8_epi32(kAll, narrow));
    }
    static constexpr size_t kFours = 4;
    PAIM_TARGET_INLINE static Vector load_fours(const float* const* rows, size_t offset) {
        Vector values = _mm512_castps128_ps512(_mm_loadu_ps(rows[0] + offset));
        values = _mm512_maskz_insertf32x4(kAll, values, _mm_loadu_ps(rows[1] + offset), 1);
        values = _mm512_maskz_insertf32x4(kAll, values, _mm_loadu_ps(rows[2] + offset), 2);
        return _mm512_maskz_insertf32x4(kAll, values, _mm_loadu_ps(rows[3] + offset), 3);
    }
    PAIM_TARGET_INLINE static Vector spread(const float* values) {
        const __m512i each_four = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
        return _mm512_maskz_permutevar_ps(
            kAll, _mm512_maskz_broadcast_f32x4(kAll, _mm_loadu_ps(values)), each_four);
    }
};
#include "paim/codec/vector_kernels.inc"
#undef PAIM_TARGET
#undef PAIM_TARGET_INLINE

}  // namespace avx512

#endif

}  // namespace

const VectorKernels& vector_kernels(VectorUnit unit) {
#if defined(__x86_64__)
    if (unit == VectorUnit::avx512) return avx512::kKernels;
    if (unit == VectorUnit::avx2) return avx2::kKernels;
#endif
    PAIM_CHECK(unit == VectorUnit::portable);
    return portable::kKernels;
}

std::span<const VectorUnit> vector_units() {
    static constexpr std::array kAll{VectorUnit::plain, VectorUnit::portable, VectorUnit::avx2,
                                     VectorUnit::avx512};
    static const size_t num_here = [] {
#if defined(__x86_64__)
        if (__builtin_cpu_supports("avx512f")) return size_t{4};
        if (__builtin_cpu_supports("avx2")) return size_t{3};
#endif
        return size_t{2};
    }();
    return std::span(kAll).first(num_here);
}

VectorUnit best_vector_unit() {
    return vector_units().back();
}

Columns::Type type_of(const StoredValues& stored) {
    if (stored.holds_floats()) return Columns::Type::f32;
    return stored.holds_i8() ? Columns::Type::i8 : Columns::Type::i16;
}

const void* values_from(const StoredValues& stored, size_t first) {
    return std::visit([first](const auto& values) -> const void* { return values.data() + first; },
                      stored.values());
}

Columns columns_from(std::span<const StoredValues> components, size_t k, size_t first) {
    Columns columns;
    columns.type = type_of(components[k]);
    while (columns.count < kMaxColumns && k + columns.count < components.size() &&
           type_of(components[k + columns.count]) == columns.type) {
        columns.values[columns.count] = values_from(components[k + columns.count], first);
        ++columns.count;
    }
    return columns;
}

}  // namespace paim
