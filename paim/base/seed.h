// Random streams keyed by pose, vertex and part, so that results do not depend on threads or order.
// Based on: Sebastiano Vigna, "splitmix64" (public domain), the finaliser of Steele, Lea and Flood,
//           Fast Splittable Pseudorandom Number Generators, 2014
#pragma once

#include <cstdint>

namespace paim {

constexpr uint64_t mix_bits(uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

// Key of the random stream of one vertex in one pose. Different `part`s give independent streams.
constexpr uint64_t stream_key(uint64_t seed, uint64_t pose, uint64_t vertex, uint64_t part = 0) {
    return mix_bits(mix_bits(mix_bits(mix_bits(seed) ^ pose) ^ vertex) ^ part);
}

// A small sequential generator for tests, shapes and anything that is not a hot loop.
class RandomStream {
  public:
    explicit constexpr RandomStream(uint64_t key) : state_(key) {}

    constexpr uint64_t next_u64() { return mix_bits(state_++ * 0xd1342543de82ef95ULL + 1); }

    // Uniform in [0, 1), 53 bits.
    constexpr double uniform() { return static_cast<double>(next_u64() >> 11) * 0x1.0p-53; }

  private:
    uint64_t state_;
};

}  // namespace paim
