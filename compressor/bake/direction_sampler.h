// The directions of a vertex's rays and their weights.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compressor/bake/cosine_directions.h"

namespace paim {

enum class SamplerKind : uint32_t {
    cosine,         // cosine-distributed, low-discrepancy: the default
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

// Points [first, first + count) of a sequence of directions. For any function f of direction, the
// sum of weight · f(ω) over the rays of a set, divided by num_points(), has the expectation
// 1/π ∫ max(0, n·ω) f(ω) dω. Each key gives an independent sequence.
class DirectionSampler {
  public:
    explicit DirectionSampler(uint32_t num_points) : num_points_(num_points) {}
    virtual ~DirectionSampler() = default;
    uint32_t num_points() const { return num_points_; }

    // normal  unit; points below its horizon contribute nothing and are not among the rays
    virtual void generate(const Vec3f& normal, uint64_t key, RaySet& out) const = 0;

  private:
    uint32_t num_points_;
};

std::unique_ptr<DirectionSampler> make_sampler(SamplerKind kind, uint32_t first, uint32_t count);

}  // namespace paim
