// The rounds of rays that each vertex of a pose traces, so that they can be made again.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/bake/direction_sampler.h"

namespace paim {

class RayRounds {
  public:
    // p  the number of the pose, which keys the random numbers
    RayRounds(const BakeOptions& options, uint32_t p, size_t num_vertices)
        : options_(options), p_(p), num_vertices_(num_vertices) {}

    // The exponent of error_power().
    double power() const { return error_power(options_.sampler); }

    // The vertex traces a round with this sampler, which the caller keeps. Rounds of a vertex are
    // added in order.
    void add(uint32_t v, size_t round, const DirectionSampler& sampler) {
        if (rounds_.size() <= round) rounds_.resize(round + 1);
        rounds_[round].resize(num_vertices_, nullptr);
        rounds_[round][v] = &sampler;
    }

    HalfKeys keys(size_t v, size_t round) const {
        return half_keys(options_, p_, static_cast<uint32_t>(v), static_cast<uint32_t>(round));
    }

    // Sets of N rays are averaged with weights N^power, so that each ray counts N^(power − 1).
    double weight(const DirectionSampler& sampler) const {
        return std::pow(2.0 * sampler.num_points(), power() - 1.0);
    }

    // use(sampler, keys, weight) for each round of a vertex. Safe to call from several threads.
    template <typename Use>
    void for_each(size_t v, const Use& use) const {
        for (size_t round = 0; round < rounds_.size(); ++round) {
            const DirectionSampler* const sampler = rounds_[round][v];
            if (sampler == nullptr) break;
            use(*sampler, keys(v, round), weight(*sampler));
        }
    }

  private:
    const BakeOptions& options_;
    const uint32_t p_;
    const size_t num_vertices_;
    // [rounds][V] what made the directions; nullptr: the vertex needed no such round
    std::vector<std::vector<const DirectionSampler*>> rounds_;
};

}  // namespace paim
