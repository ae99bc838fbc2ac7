// How many rays a traced reference needs.
#include "analysis/reference/enough_rays.h"

#include <algorithm>
#include <cmath>

#include "paim/metrics/image_error.h"

namespace paim {

namespace {

// Noise falls as rays to this power, at least.
constexpr double kFall = 0.5;
// Some more than what just does: one pose tells of the others.
constexpr double kMargin = 0.8;

// How many times too large the noise is under a light; 0 where nothing is to be seen.
double excess(const ReferencePictures& traced, const std::vector<Image>& pictures, size_t light,
              size_t num_lights) {
    RelativeNoise noise(num_lights);
    noise.add(traced);
    ImageError error;
    for (size_t j = light; j < pictures.size(); j += num_lights) {
        error.add(compare_images(pictures[j], traced.pictures[j]));
    }
    const double ratio = noise.relative()[light] / (kMargin * kNoiseOfError * error.visual_error());
    return ratio > 0.0 ? ratio : 0.0;
}

uint32_t multiple_of_4(double rays) {
    return 4 * static_cast<uint32_t>(std::ceil(rays / 4.0));
}

}  // namespace

void take_enough_rays(const BakeReader& bake, const Stage& stage, TracedAt at,
                      TracedReference& reference) {
    const uint32_t p = stage.poses().front();
    const std::vector<Image> pictures = stage.render_pose(baked_pose(bake, p, bake.read_pose(p)));
    const size_t num_lights = stage.lights().size();
    for (bool is_enough = false; !is_enough;) {
        is_enough = true;
        const ReferencePictures traced = reference.trace(p, at);
        for (size_t light = 0; light < num_lights; ++light) {
            const uint32_t rays = reference.rays(light);
            const double ratio = excess(traced, pictures, light, num_lights);
            if (ratio <= 1.0 || rays >= kMostReferenceRays) continue;
            const double factor = std::clamp(std::pow(ratio, 1.0 / kFall), 1.3, 8.0);
            reference.set_rays(light,
                               multiple_of_4(std::min<double>(kMostReferenceRays, factor * rays)));
            is_enough = false;
        }
    }
}

}  // namespace paim
