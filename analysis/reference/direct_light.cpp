// Light from an environment map that arrives at a point.
#include "analysis/reference/direct_light.h"

#include <algorithm>
#include <cmath>

#include "compressor/bake/sobol.h"
#include "paim/base/check.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

// Sets of directions by the light, of each half. Points that take the same set have half of their rays in
// common, in every pose. Their errors are not independent, which moves no mean and no estimate of noise.
constexpr uint64_t kSets = 64;

// Where along a curve that visits neighbours one after another a direction is: the bits of its three
// coordinates, interleaved.
uint32_t morton_code(const Vec3f& direction) {
    uint32_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto place =
            static_cast<uint32_t>(std::clamp(512.0f * (direction[axis] + 1.0f), 0.0f, 1023.0f));
        for (uint32_t bit = 0; bit < 10; ++bit) {
            code |= (place >> bit & 1u) << (3 * bit + static_cast<uint32_t>(axis));
        }
    }
    return code;
}

// 1/π L max(0, n·ω) by the density of both ways to find the direction.
Vec3d weighted(const LightSampler::Sample& sample, const Vec3f& normal) {
    const double cosine_density = static_cast<double>(sample.direction.dot(normal)) / kPi;
    const double density = cosine_density + static_cast<double>(sample.density);
    return cosine_density / density * sample.radiance.cast<double>();
}

}  // namespace

DirectLight::DirectLight(const LightSampler& light, uint32_t rays, uint64_t seed)
    : light_(&light), num_points_(rays / 4), cosine_(num_points_, 1) {
    PAIM_CHECK_LE(4u, rays);
    PAIM_CHECK_EQ(rays % 4, 0u);
    if (light.is_black()) return;
    for (uint64_t half = 0; half < 2; ++half) {
        for (uint64_t set = 0; set < kSets; ++set) {
            sets_[half].push_back(make_set(stream_key(seed, half, set)));
        }
    }
}

DirectLight::LightSet DirectLight::make_set(uint64_t key) const {
    const SobolPoints sobol(num_points_);
    const auto seed_u = static_cast<uint32_t>(key), seed_v = static_cast<uint32_t>(key >> 32);
    LightSet set;
    for (uint32_t j = 0; j < num_points_; ++j) {
        const auto u = static_cast<double>(scrambled_fraction(sobol.reversed_x[j], seed_u));
        const auto v = static_cast<double>(scrambled_fraction(sobol.reversed_y[j], seed_v));
        const LightSampler::Sample sample = light_->sample(u, v);
        // Black pixels have no weight, but rounding may find the edge of one.
        if (!sample.radiance.isZero(0.0f)) set.push_back(sample);
    }
    std::stable_sort(set.begin(), set.end(), [](const auto& a, const auto& b) {
        return morton_code(a.direction) < morton_code(b.direction);
    });
    return set;
}

Vec3d DirectLight::sum_cosine(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                              uint64_t key, Workspace& work) const {
    DirectionArrays& to = work.directions;
    cosine_.generate(normal, key, 0, to);
    work.occluded.assign(to.x.size(), 0.0f);
    occluded_from(scene, start, to.x.data(), to.y.data(), to.z.data(), num_points_,
                  work.occluded.data());
    Vec3d total = Vec3d::Zero();
    for (uint32_t j = 0; j < num_points_; ++j) {
        if (work.occluded[j] > 0.0f) continue;
        const LightSampler::Sample seen = light_->look(Vec3f(to.x[j], to.y[j], to.z[j]));
        if (seen.radiance.isZero(0.0f) || seen.direction.dot(normal) <= 0.0f) continue;
        total += weighted(seen, normal);
    }
    return total / num_points_;
}

Vec3d DirectLight::sum_light(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                             const LightSet& set, Workspace& work) const {
    work.samples.clear();
    for (const LightSampler::Sample& sample : set) {
        if (sample.direction.dot(normal) > 0.0f) work.samples.push_back(&sample);
    }
    const auto count = static_cast<uint32_t>(work.samples.size());
    DirectionArrays& to = work.directions;
    for (auto* array : {&to.x, &to.y, &to.z}) array->assign(DirectionArrays::padded(count), 0.0f);
    for (uint32_t j = 0; j < count; ++j) {
        const Vec3f& direction = work.samples[j]->direction;
        to.x[j] = direction.x();
        to.y[j] = direction.y();
        to.z[j] = direction.z();
    }
    work.occluded.assign(to.x.size(), 0.0f);
    occluded_from(scene, start, to.x.data(), to.y.data(), to.z.data(), count, work.occluded.data());
    Vec3d total = Vec3d::Zero();
    for (uint32_t j = 0; j < count; ++j) {
        if (work.occluded[j] == 0.0f) total += weighted(*work.samples[j], normal);
    }
    return total / num_points_;
}

LightHalves DirectLight::at(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                            uint64_t key, Workspace& work) const {
    LightHalves halves{Vec3f::Zero(), Vec3f::Zero()};
    if (light_->is_black()) return halves;
    for (uint64_t half = 0; half < 2; ++half) {
        const LightSet& set = sets_[half][mix_bits(key ^ (2 * half)) % kSets];
        const Vec3d sum = sum_cosine(scene, start, normal, mix_bits(key ^ (2 * half + 1)), work) +
                          sum_light(scene, start, normal, set, work);
        halves[half] = sum.cast<float>();
    }
    return halves;
}

}  // namespace paim
