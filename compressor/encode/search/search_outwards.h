// The place of the smallest in a row of sizes that fall, and then grow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace paim {

// The size of what is too large to be of use, whatever the smallest is.
constexpr uint64_t kTooLarge = std::numeric_limits<uint64_t>::max();

// Tries places from `start` upwards, then downwards, each way until a size is clearly larger than
// the smallest so far. Returns the place of the smallest; `start` if there is none.
// size_of(n)  the size at place n, called once for each place that is tried; nothing if there is
//             none. Places below one without a size have none either.
template <typename SizeOf>
size_t search_outwards(size_t num_places, size_t start, SizeOf&& size_of) {
    // Sizes scatter by about so much.
    constexpr double kClearly = 1.03;
    size_t first = start;  // with a size
    std::optional<uint64_t> size;
    while (first < num_places && !(size = size_of(first))) ++first;
    if (!size) return start;
    size_t best = first;
    uint64_t smallest = *size;
    // Whether sizes past this place may be smaller.
    const auto go_on = [&](size_t n) {
        const std::optional<uint64_t> next = size_of(n);
        if (!next) return false;
        if (*next < smallest) {
            smallest = *next;
            best = n;
        }
        return static_cast<double>(*next) <= kClearly * static_cast<double>(smallest);
    };
    for (size_t n = first + 1; smallest < kTooLarge && n < num_places && go_on(n); ++n) {
    }
    if (first > start) return best;
    for (size_t n = start; n-- > 0 && go_on(n);) {
    }
    return best;
}

}  // namespace paim
