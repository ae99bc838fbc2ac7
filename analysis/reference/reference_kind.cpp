// Which pictures errors are measured against.
#include "analysis/reference/reference_kind.h"

#include <fmt/format.h>

#include "analysis/reference/enough_rays.h"

namespace paim {

Reference make_reference(ReferenceKind kind, uint32_t rays, const BakeReader& bake,
                         const Stage& stage) {
    if (kind == ReferenceKind::bake) {
        const auto render = [&stage](uint32_t, const DecodedPose& baked) {
            return ReferencePictures{stage.render_pose(baked), {}};
        };
        return {render, "the bake", nullptr, false};
    }
    constexpr uint32_t kFirstRays = 64;
    rays = (rays + 3) / 4 * 4;
    const TracedAt at =
        kind == ReferenceKind::traced_pixels ? TracedAt::pixels : TracedAt::vertices;
    Reference reference;
    reference.traced = std::make_shared<TracedReference>(bake, stage, rays > 0 ? rays : kFirstRays);
    reference.rays_were_chosen = rays == 0;
    if (rays == 0) take_enough_rays(bake, stage, at, *reference.traced);
    reference.source = [traced = reference.traced, at](uint32_t p, const DecodedPose&) {
        return traced->trace(p, at);
    };
    reference.name = at == TracedAt::pixels ? "traced at pixels" : "traced at vertices";
    return reference;
}

std::string noise_note(const Reference& reference, const Stage& stage, size_t light, double noise,
                       double error) {
    if (!(noise > kNoiseOfError * error)) return {};
    return fmt::format(
        "light {}: the reference has {:.2g} % noise by {} rays, more than a fifth of the smallest "
        "error, {:.2g} %{}",
        stage.lights()[light].name, 100.0 * noise, reference.traced->rays(light), 100.0 * error,
        reference.rays_were_chosen ? "" : "; more --reference-rays make it smaller");
}

}  // namespace paim
