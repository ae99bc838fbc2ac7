// The cheapest integers for a part of an animation.
#include "compressor/encode/search/part_search.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "compressor/encode/memory/search_limits.h"
#include "compressor/encode/search/matrix_cost.h"
#include "compressor/encode/search/search_outwards.h"

namespace paim {

std::vector<double> tail_errors(const ScaledFactors& factors,
                                const std::vector<double>& plane_weight) {
    std::vector<double> tails(factors.num_components() + 1, 0.0);
    for (uint32_t k = factors.num_components(); k-- > 0;) {
        double energy = 0.0;
        for (uint32_t j = 0; j < factors.num_planes; ++j) {
            double sum = 0.0;
            for (const float value : factors.plane(factors.components[k], j)) {
                sum += static_cast<double>(value) * static_cast<double>(value);
            }
            energy += plane_weight[j] * sum;
        }
        tails[k] = tails[k + 1] + factors.num_poses() * energy;
    }
    return tails;
}

std::vector<PartChoice> part_choices(const ScaledFactors& factors,
                                     const std::vector<double>& plane_weight, double most_error,
                                     uint32_t most_components, const PlanePredictor& predictor,
                                     uint32_t num_counted, uint32_t least_components,
                                     Preference preference) {
    ScaledFactors few = num_counted == factors.num_points
                            ? sample(factors, kSampledValues)
                            : sample(first_points(factors, num_counted), kSampledValues);
    const Quantiser all{1.0, factors.num_components(), plane_weight};
    if (smallest_step(few, all, Precision::i16) == 0.0) {  // it missed what there is
        few = first_points(factors, num_counted);
    }
    const double sampled = static_cast<double>(few.num_points) / num_counted;
    const std::vector<double> tails = tail_errors(factors, plane_weight);

    // Shares of the error that dropped components may take.
    constexpr std::array<double, 6> kShares{0.0, 0.1, 0.25, 0.45, 0.65, 0.8};
    std::set<uint32_t> counts;
    for (const double share : kShares) {
        uint32_t k = 0;
        while (k < factors.num_components() && tails[k] > share * most_error) ++k;
        counts.insert(std::clamp(k, std::min(least_components, most_components), most_components));
    }
    const std::vector<uint32_t> ascending(counts.begin(), counts.end());
    std::map<uint32_t, PartChoice> choices;
    const auto size_of = [&](size_t n) -> std::optional<uint64_t> {
        const uint32_t count = ascending[n];
        if (tails[count] > most_error) return std::nullopt;
        PartChoice choice;
        choice.quantiser = {1.0, count, plane_weight};
        // What is dropped is known of all points.
        choice.quantiser.step = largest_step(first_components(few, count), choice.quantiser,
                                             sampled * (most_error - tails[count]));
        if (choice.quantiser.step == 0.0) return std::nullopt;
        choice.quantiser.step = std::max(choice.quantiser.step,
                                         smallest_step(factors, choice.quantiser, Precision::i16));
        const LowRank matrix = quantise(factors, choice.quantiser);
        choice.num_components = matrix.num_components;
        choice.bytes = stored_bytes(matrix, predictor, Effort::fast);
        return choices.emplace(count, std::move(choice)).first->second.bytes;
    };
    if (preference == Preference::size) {
        search_outwards(ascending.size(), ascending.size() / 2, size_of);
    } else {
        for (size_t n = 0; n < ascending.size(); ++n) size_of(n);
    }
    std::vector<PartChoice> result;
    for (auto& [count, choice] : choices) result.push_back(std::move(choice));
    return result;
}

uint32_t fewest_components(const std::vector<double>& tails, double most_error) {
    uint32_t k = 0;
    while (k + 1 < tails.size() && tails[k] > most_error) ++k;
    return k;
}

std::optional<PartChoice> cheapest_part(std::vector<PartChoice> choices) {
    if (choices.empty()) return std::nullopt;
    uint64_t fewest = choices[0].bytes;
    for (const PartChoice& choice : choices) fewest = std::min(fewest, choice.bytes);
    // Counts ascend.
    const auto best = std::find_if(choices.begin(), choices.end(), [&](const PartChoice& choice) {
        return choice.bytes <= fewest + fewest / 100;
    });
    return std::move(*best);
}

}  // namespace paim
