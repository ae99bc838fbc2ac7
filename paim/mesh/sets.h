// Disjoint sets of numbers.
// Based on: Galler and Fischer, An Improved Equivalence Algorithm, 1964
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace paim {

// Sets of the numbers below n, at first one each. A set is known by its lowest number.
class Sets {
  public:
    explicit Sets(size_t n) : parents_(n) { std::iota(parents_.begin(), parents_.end(), 0u); }

    uint32_t lowest(uint32_t v) {
        while (parents_[v] != v) v = parents_[v] = parents_[parents_[v]];
        return v;
    }
    void join(uint32_t a, uint32_t b) {
        a = lowest(a);
        b = lowest(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<uint32_t> parents_;
};

}  // namespace paim
