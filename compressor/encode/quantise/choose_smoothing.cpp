// How often each plane of quantised positions is smoothed when it is read.
#include "compressor/encode/quantise/choose_smoothing.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "paim/base/parallel.h"

namespace paim {

namespace {

// The number of rounds after which a plane is nearest to what it was rounded from.
// exact   [V] scaled by 1 / step
// stored  [V]
uint32_t best_rounds(const SurfaceSmoother& smoother, std::span<const float> exact, float step,
                     std::span<const float> stored, float reach) {
    constexpr std::array<uint32_t, 4> kRounds{1, 2, 4, kMaxSmoothingRounds};
    std::vector<float> values(stored.begin(), stored.end());
    const auto error = [&] {
        double sum = 0.0;
        for (size_t v = 0; v < values.size(); ++v) {
            const double off = double{values[v]} - double{exact[v]} / double{step};
            sum += off * off;
        }
        return sum;
    };
    uint32_t best = 0, done = 0;
    double least = error();
    for (const uint32_t rounds : kRounds) {
        smoother.smooth(stored, rounds - done, reach, values);
        done = rounds;
        if (const double left = error(); left < least) {
            least = left;
            best = rounds;
        }
    }
    return best;
}

}  // namespace

void smooth_quantised(const ScaledFactors& factors, const SurfaceSmoother& smoother,
                      LowRank& matrix) {
    const uint32_t bits = smoothing_fraction_bits(matrix);
    if (bits == 0) return;
    std::vector<uint32_t> rounds((1 + size_t{matrix.num_components}) * matrix.num_planes);
    parallel_for(rounds.size(), 1, [&](size_t task, size_t) {
        const size_t array = task / matrix.num_planes;
        const auto plane = static_cast<uint32_t>(task % matrix.num_planes);
        const auto k = static_cast<uint32_t>(array - 1);
        const StoredValues& values = array == 0 ? matrix.mean : matrix.components[k];
        std::vector<float> stored(matrix.num_points);
        values.widen(size_t{plane} * matrix.num_points, stored);
        const std::vector<float>& exact =
            array == 0 ? factors.mean : factors.components[matrix.singular_index(k)];
        rounds[task] = best_rounds(smoother, factors.plane(exact, plane), matrix.steps[plane],
                                   stored, smoothing_reach(bits));
    });
    if (std::all_of(rounds.begin(), rounds.end(), [](uint32_t n) { return n == 0; })) return;
    matrix.fraction_bits = bits;
    matrix.smoothing = std::move(rounds);
    smooth_stored(matrix, smoother);
}

LowRank smoothed(const ScaledFactors& factors, const Quantiser& quantiser,
                 const SurfaceSmoother& smoother) {
    LowRank matrix = quantise(factors, quantiser);
    smooth_quantised(factors, smoother, matrix);
    return matrix;
}

}  // namespace paim
