// Sums of weighted components.
#include "paim/codec/accumulate.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/codec/vector_kernels.h"

namespace paim {

namespace {

// Points whose sums (32 KB) stay in the first- or second-level cache while all components are
// added.
constexpr size_t kPoints = 8192;

void accumulate_plain(const StoredValues& mean, std::span<const StoredValues> components,
                      std::span<const float> weights, float step, size_t first,
                      std::span<float> out) {
    for (size_t n = 0; n < out.size(); ++n) {
        float value = mean[first + n];
        for (size_t k = 0; k < components.size(); ++k) {
            value += weights[k] * components[k][first + n];
        }
        out[n] = step * value;
    }
}

}  // namespace

void accumulate(const StoredValues& mean, std::span<const StoredValues> components,
                std::span<const float> weights, float step, size_t first, std::span<float> out,
                VectorUnit unit) {
    PAIM_CHECK_EQ(components.size(), weights.size());
    PAIM_CHECK(first <= mean.size() && out.size() <= mean.size() - first);
    for (const StoredValues& component : components) PAIM_CHECK_EQ(component.size(), mean.size());
    if (unit == VectorUnit::plain) {
        return accumulate_plain(mean, components, weights, step, first, out);
    }
    const VectorKernels& use = vector_kernels(unit);
    for (size_t begin = 0; begin < out.size(); begin += kPoints) {
        const std::span<float> to = out.subspan(begin, std::min(kPoints, out.size() - begin));
        const size_t from = first + begin;
        use.widen(type_of(mean), values_from(mean, from), to.data(), to.size());
        for (size_t k = 0; k < components.size();) {
            const Columns columns = columns_from(components, k, from);
            use.add(columns, weights.data() + k, to.data(), to.size());
            k += columns.count;
        }
        if (step != 1.0f) use.scale(step, to.data(), to.size());
    }
}

}  // namespace paim
