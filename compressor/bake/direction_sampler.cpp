// The directions of a vertex's rays and their weights.
#include "compressor/bake/direction_sampler.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "compressor/bake/sobol.h"
#include "paim/base/error.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

class CosineSampler : public DirectionSampler {
  public:
    CosineSampler(uint32_t first, uint32_t count)
        : DirectionSampler(count), directions_(first, count) {}

    void generate(const Vec3f& normal, uint64_t key, RaySet& out) const override {
        directions_.generate(normal, key, out);
        out.num_rays = num_points();
        out.weights.assign(out.x.size(), 0.0f);
        std::fill_n(out.weights.begin(), out.num_rays, 1.0f);
    }

  private:
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
    UniformSampler(uint32_t first, uint32_t count) : DirectionSampler(count), first_(first) {}

    void generate(const Vec3f& normal, uint64_t key, RaySet& out) const override {
        UniformSet set(normal, out);
        RandomStream random(key + 2 * uint64_t{first_});
        for (uint32_t j = 0; j < num_points(); ++j) {
            const double u = random.uniform();
            set.add(u, random.uniform());
        }
        set.finish();
    }

  private:
    uint32_t first_;
};

class UniformSobolSampler : public DirectionSampler {
  public:
    UniformSobolSampler(uint32_t first, uint32_t count)
        : DirectionSampler(count), points_(first, count) {}

    void generate(const Vec3f& normal, uint64_t key, RaySet& out) const override {
        UniformSet set(normal, out);
        for (uint32_t j = 0; j < num_points(); ++j) {
            set.add(scrambled_fraction(points_.reversed_x[j], static_cast<uint32_t>(key)),
                    scrambled_fraction(points_.reversed_y[j], static_cast<uint32_t>(key >> 32)));
        }
        set.finish();
    }

  private:
    SobolPoints points_;
};

}  // namespace

std::unique_ptr<DirectionSampler> make_sampler(SamplerKind kind, uint32_t first, uint32_t count) {
    switch (kind) {
        case SamplerKind::cosine:
            break;
        case SamplerKind::uniform:
            return std::make_unique<UniformSampler>(first, count);
        case SamplerKind::uniform_sobol:
            return std::make_unique<UniformSobolSampler>(first, count);
    }
    return std::make_unique<CosineSampler>(first, count);
}

}  // namespace paim
