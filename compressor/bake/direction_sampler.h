// The directions of a vertex's rays and their weights.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "compressor/bake/cosine_directions.h"

namespace paim {

enum class SamplerKind : uint32_t {
    cosine,         // cosine-distributed, a lattice on a spiral: the default
    uniform,        // uniform over the sphere, random: the slow reference
    uniform_sobol,  // uniform over the sphere, low-discrepancy
};

// The name in options and manifests: "cosine", "uniform" or "uniform-sobol".
constexpr const char* sampler_name(SamplerKind kind) {
    switch (kind) {
        case SamplerKind::cosine:
            return "cosine";
        case SamplerKind::uniform:
            return "uniform";
        case SamplerKind::uniform_sobol:
            return "uniform-sobol";
    }
    return "unknown";
}

constexpr SamplerKind kSamplerKinds[] = {SamplerKind::cosine, SamplerKind::uniform,
                                         SamplerKind::uniform_sobol};

// The exponent p of the squared error ∝ rays^−p of a mean over directions: 1 for random points, and
// 1.5 for low-discrepancy points, as measured for occluders with edges.
constexpr double error_power(SamplerKind kind) {
    return kind == SamplerKind::uniform ? 1.0 : 1.5;
}

// Directions to trace, with weights. Both are padded with zeros.
struct RaySet : DirectionArrays {
    std::vector<float> weights;
    uint32_t num_rays = 0;
};

// The random numbers of both halves of a vertex's rays. A sampler whose halves belong together takes
// them all from the first key.
using HalfKeys = std::array<uint64_t, 2>;

// Two sets of directions, the halves of a vertex's rays. For any function f of direction, the sum of
// weight · f(ω) over the rays of a half, divided by num_points(), has the expectation
// 1/π ∫ max(0, n·ω) f(ω) dω. Other keys give independent sets.
class DirectionSampler {
  public:
    explicit DirectionSampler(uint32_t num_points) : num_points_(num_points) {}
    virtual ~DirectionSampler() = default;

    // Points of a half.
    uint32_t num_points() const { return num_points_; }

    // normal  unit; points below its horizon contribute nothing and are not among the rays
    // half    0 or 1
    virtual void generate(const Vec3f& normal, const HalfKeys& keys, uint32_t half,
                          RaySet& out) const = 0;

    // What half the difference of the halves' means is multiplied by, to have the variance of the
    // error of their mean: 1 if the halves are independent, less if they are better together.
    virtual double noise_scale() const { return 1.0; }

  private:
    uint32_t num_points_;
};

// How the halves of the rays go together.
enum class HalfRelation {
    interleaved,  // halves of one set, if the sampler has such
    independent,  // each with a key of its own
};

// num_points  of a half
std::unique_ptr<DirectionSampler> make_sampler(SamplerKind kind, uint32_t num_points,
                                               HalfRelation relation);

}  // namespace paim
