// Which values the exposure is for.
#include "player/light/auto_exposure.h"

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/image/tone.h"
#include "paim/sh/cosine_lobe.h"
#include "player/light/reconstruct_light.h"

namespace paim::player {

namespace {

constexpr size_t kMaxValues = 65536;

float limited_exposure_ev(std::span<const Vec3f> radiance) {
    return std::clamp(suggested_exposure_ev(radiance), -kLargestExposure_ev, kLargestExposure_ev);
}

}  // namespace

float auto_exposure_ev(std::span<const std::span<const Vec3f>> parts) {
    size_t total = 0;
    for (const auto& part : parts) total += part.size();
    const size_t step = std::max<size_t>(1, (total + kMaxValues - 1) / kMaxValues);
    std::vector<Vec3f> values;
    size_t at = 0;  // of the vertices of all parts, one after the other
    for (const auto& part : parts) {
        for (; at < part.size(); at += step) values.push_back(part[at]);
        at -= part.size();
    }
    return limited_exposure_ev(values);
}

float auto_exposure_ev(const LightCoefficients& light) {
    static const std::vector<Vec3f> normals = equal_area_directions(1024);
    LightCoefficients reflected = light;
    for (int l = 0; l < light.bands; ++l) {
        const auto factor = static_cast<float>(sh::cosine_lobe(l));
        for (int m = -l; m <= l; ++m) {
            reflected.values[static_cast<size_t>(sh::index(l, m))] *= factor;
        }
    }
    std::vector<Vec3f> radiance(normals.size());
    reconstruct_light(reflected, normals, radiance);
    return limited_exposure_ev(radiance);
}

}  // namespace paim::player
