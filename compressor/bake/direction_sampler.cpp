// The directions of a vertex's rays and their weights.
#include "compressor/bake/direction_sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "compressor/bake/sobol.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

// The standard deviation of half the difference of a spiral's halves, relative to that of the error
// of the whole. If squared errors of sets and of halves fell as N^-1.5 alike, it would be
// √(2^1.5 − 1). Halves of a few points are nearly independent, and those of up to hundreds also differ
// where light changes smoothly. What is between the limits is observed, on five meshes, and true
// within 5 % (docs/results/noise.md).
double half_difference_ratio(uint32_t num_points) {
    struct Known {
        double log2_points, ratio;
    };
    constexpr Known kKnown[] = {{1.0, 1.1}, {5.0, 1.42}, {11.0, 1.37}, {14.0, 1.352}};
    const double at = std::log2(num_points);
    for (size_t k = 1; k < std::size(kKnown); ++k) {
        const Known& before = kKnown[k - 1];
        const Known& after = kKnown[k];
        if (at > after.log2_points) continue;
        const double share = (at - before.log2_points) / (after.log2_points - before.log2_points);
        return before.ratio + share * (after.ratio - before.ratio);
    }
    return std::sqrt(std::pow(2.0, 1.5) - 1.0);
}

class SpiralSampler : public DirectionSampler {
  public:
    SpiralSampler(uint32_t num_points, HalfRelation relation)
        : DirectionSampler(num_points),
          relation_(relation),
          directions_(relation == HalfRelation::interleaved ? CosineDirections(2 * num_points, 2)
                                                            : CosineDirections(num_points, 1)) {}

    void generate(const Vec3f& normal, const HalfKeys& keys, uint32_t half,
                  RaySet& out) const override {
        if (relation_ == HalfRelation::interleaved) {
            directions_.generate(normal, keys[0], half, out);
        } else {
            directions_.generate(normal, keys[half], 0, out);
        }
        out.num_rays = num_points();
        out.weights.assign(out.x.size(), 0.0f);
        std::fill_n(out.weights.begin(), out.num_rays, 1.0f);
    }

    double noise_scale() const override {
        return relation_ == HalfRelation::interleaved
                   ? 1.0 / half_difference_ratio(2 * num_points())
                   : 1.0;
    }

  private:
    HalfRelation relation_;
    CosineDirections directions_;
};

// Fills a set with directions from points in the unit square. They are uniform over the sphere by
// Archimedes' hat-box theorem.
class UniformSet {
  public:
    UniformSet(const Vec3f& normal, RaySet& out) : normal_(normal), out_(out) {
        for (auto* array : {&out.x, &out.y, &out.z, &out.weights}) array->clear();
    }

    void add(double u, double v) {
        const double height = 1.0 - 2.0 * u;
        const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
        const Vec3f w(static_cast<float>(radius * std::cos(2.0 * kPi * v)),
                      static_cast<float>(radius * std::sin(2.0 * kPi * v)),
                      static_cast<float>(height));
        const float cosine = w.dot(normal_);
        if (!(cosine > 0.0f)) return;
        out_.x.push_back(w.x());
        out_.y.push_back(w.y());
        out_.z.push_back(w.z());
        out_.weights.push_back(4.0f * cosine);  // (cos θ / π) / (1 / 4π)
    }

    void finish() {
        out_.num_rays = static_cast<uint32_t>(out_.x.size());
        const size_t padded = RaySet::padded(out_.num_rays);
        for (auto* array : {&out_.x, &out_.y, &out_.z, &out_.weights}) array->resize(padded, 0.0f);
    }

  private:
    const Vec3f normal_;
    RaySet& out_;
};

class UniformSampler : public DirectionSampler {
  public:
    using DirectionSampler::DirectionSampler;

    void generate(const Vec3f& normal, const HalfKeys& keys, uint32_t half,
                  RaySet& out) const override {
        UniformSet set(normal, out);
        RandomStream random(keys[half]);
        for (uint32_t j = 0; j < num_points(); ++j) {
            const double u = random.uniform();
            set.add(u, random.uniform());
        }
        set.finish();
    }
};

class UniformSobolSampler : public DirectionSampler {
  public:
    UniformSobolSampler(uint32_t num_points, HalfRelation relation)
        : DirectionSampler(num_points),
          relation_(relation),
          points_(relation == HalfRelation::interleaved ? 2 * num_points : num_points) {}

    // Halves of one set are the first and the second part of the sequence, so that powers of two
    // are nets by themselves and together. A random bit says which is which.
    void generate(const Vec3f& normal, const HalfKeys& keys, uint32_t half,
                  RaySet& out) const override {
        const bool is_one_set = relation_ == HalfRelation::interleaved;
        const uint64_t key = keys[is_one_set ? 0 : half];
        const bool is_second = is_one_set && (half ^ (mix_bits(key) & 1u)) != 0;
        const uint32_t first = is_second ? num_points() : 0;
        UniformSet set(normal, out);
        for (uint32_t j = first; j < first + num_points(); ++j) {
            set.add(scrambled_fraction(points_.reversed_x[j], static_cast<uint32_t>(key)),
                    scrambled_fraction(points_.reversed_y[j], static_cast<uint32_t>(key >> 32)));
        }
        set.finish();
    }

    // As a spiral's halves (half_difference_ratio), for powers of two. Halves of other numbers of
    // points are further apart, as they are no nets.
    double noise_scale() const override {
        if (relation_ == HalfRelation::independent) return 1.0;
        return std::has_single_bit(num_points()) ? 1.0 / 1.37 : 1.0 / 1.48;
    }

  private:
    HalfRelation relation_;
    SobolPoints points_;
};

}  // namespace

std::unique_ptr<DirectionSampler> make_sampler(SamplerKind kind, uint32_t num_points,
                                               HalfRelation relation) {
    switch (kind) {
        case SamplerKind::cosine:
            break;
        case SamplerKind::uniform:
            return std::make_unique<UniformSampler>(num_points);
        case SamplerKind::uniform_sobol:
            return std::make_unique<UniformSobolSampler>(num_points, relation);
    }
    return std::make_unique<SpiralSampler>(num_points, relation);
}

}  // namespace paim
