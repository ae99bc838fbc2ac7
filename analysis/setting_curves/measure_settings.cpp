// Compares the transfer of every value of a setting with a reference.
#include "analysis/setting_curves/measure_settings.h"

#include <utility>

#include "analysis/measure.h"

namespace paim {

std::function<SettingReference(uint32_t p)> compared_with_bake(const BakeReader& bake,
                                                               const Reference& reference) {
    return [&bake, &reference](uint32_t p) {
        DecodedPose baked = baked_pose(bake, p, bake.read_pose(p));
        ReferencePictures pictures = reference.source(p, baked);
        return SettingReference{std::move(baked), std::move(pictures)};
    };
}

void measure_settings(SettingCurve& curve, const std::vector<SettingSource>& sources,
                      const Stage& stage,
                      const std::function<SettingReference(uint32_t p)>& reference,
                      const std::function<void()>& on_step) {
    std::vector<ArrayError> errors(sources.size());
    RelativeNoise noise(stage.lights().size());
    for (const uint32_t p : stage.poses()) {
        SettingReference expected = reference(p);
        noise.add(expected.pictures);
        const std::vector<VisiblePoints> visible = stage.look(stage.place(expected.pose));
        for (size_t j = 0; j < sources.size(); ++j) {
            const DecodedPose pose = sources[j].pose(p);
            add_transfer(errors[j], pose, expected.pose, p);
            add_pictures(curve.settings[j], stage, p,
                         stage.draw(visible, stage.light(pose, sources[j].still)),
                         expected.pictures.pictures);
            on_step();
        }
        if (p == stage.poses().front()) {
            curve.reference = std::move(expected.pictures.pictures);
            curve.reference.resize(stage.lights().size());
        }
    }
    for (size_t j = 0; j < sources.size(); ++j) {
        curve.settings[j].columns.push_back({"transfer_error", "fraction", errors[j].relative()});
    }
    curve.noise = noise.relative();
}

}  // namespace paim
