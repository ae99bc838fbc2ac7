// Error curve over the rays of a bake.
#include "analysis/setting_curves/ray_curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "analysis/reference/baked_poses.h"
#include "analysis/reference/transfer_truth.h"
#include "analysis/seconds_of.h"
#include "analysis/setting_curves/measure_settings.h"

namespace paim {

namespace {

// Poses of a bake with other rays, and the noise that they state.
class RayBake {
  public:
    RayBake(const BakeReader& bake, const BakeOptions& options) : transfer_(bake, options) {}

    uint32_t rays() const { return transfer_.rays(); }
    const DecodedPose* still() const { return transfer_.still(); }

    DecodedPose pose(uint32_t p) {
        std::vector<float> noise;
        DecodedPose pose;
        seconds_ += seconds_of([&] { pose = transfer_.pose(p, &noise); });
        for (const float d : noise) noise_squares_ += static_cast<double>(d) * d;
        for (const float t : pose.transfer) transfer_squares_ += static_cast<double>(t) * t;
        ++num_poses_;
        return pose;
    }

    // Of all poses so far. Not a number if no light reaches any vertex.
    double relative_noise() const { return std::sqrt(noise_squares_ / transfer_squares_); }
    double seconds_per_pose() const { return seconds_ / num_poses_; }

  private:
    RebakedTransfer transfer_;
    double noise_squares_ = 0.0, transfer_squares_ = 0.0, seconds_ = 0.0;
    uint32_t num_poses_ = 0;
};

BakeOptions options_with(const BakeReader& bake, uint32_t rays) {
    BakeOptions options = options_of(bake.identity());
    options.rays = rays;
    return options;
}

// Still meshes that reflect nothing; nothing if there are none.
std::optional<DecodedPose> without_light(const DecodedPose* still) {
    if (still == nullptr) return std::nullopt;
    DecodedPose dark = *still;
    std::fill(dark.transfer.begin(), dark.transfer.end(), 0.0f);
    return dark;
}

// Pictures of the noise are those of the noise as transfer, since light is linear. Noise of still meshes
// is left out.
SettingReference pictures_of_truth(const TransferTruth& truth, const Stage& stage, uint32_t p) {
    std::vector<float> noise;
    SettingReference reference{truth.pose(p, &noise), {}};
    const std::vector<VisiblePoints> visible = stage.look(stage.place(reference.pose));
    reference.pictures.pictures = stage.draw(visible, stage.light(reference.pose, truth.still()));
    DecodedPose of_noise = reference.pose;
    of_noise.transfer = std::move(noise);
    const std::optional<DecodedPose> dark = without_light(truth.still());
    reference.pictures.noise = stage.draw(visible, stage.light(of_noise, dark ? &*dark : nullptr));
    return reference;
}

using RayBakes =
    std::vector<std::unique_ptr<RayBake>>;  // as the settings of a curve, most rays first

// Once all poses are baked.
void add_noise(const RayBakes& bakes, SettingCurve& curve) {
    const RayBake& most = *bakes.front();
    for (size_t j = 0; j < bakes.size(); ++j) {
        const double expected = expected_noise(most.relative_noise(), most.rays(), bakes[j]->rays(),
                                               BakeOptions().sampler);
        std::vector<Column>& columns = curve.settings[j].columns;
        columns.insert(columns.begin(), {{"expected_noise", "fraction", expected},
                                         {"stated_noise", "fraction", bakes[j]->relative_noise()}});
        columns.push_back({"bake", "s per pose", bakes[j]->seconds_per_pose()});
    }
}

std::string explanation_of(const Stage& stage, uint32_t true_rays, uint32_t most_rays) {
    return fmt::format(
        "{} poses are baked again with each number of rays, and with {} rays as the truth that transfer and "
        "pictures are compared with. Expected noise is that of {} rays times the power law of the sampler, "
        "rays^{:.3g}; stated noise is what each bake says of itself.",
        stage.poses().size(), true_rays, most_rays, -0.5 * error_power(BakeOptions().sampler));
}

}  // namespace

double expected_noise(double noise, uint32_t from_rays, uint32_t rays, SamplerKind sampler) {
    const double ratio = static_cast<double>(rays) / from_rays;
    return noise * std::pow(ratio, -0.5 * error_power(sampler));
}

size_t ray_curve_steps(const BakeReader& bake, const Stage& stage,
                       const std::vector<uint32_t>& wanted) {
    // The truth takes a step, too.
    return (values_up_to(bake.identity().rays, wanted).size() + 1) * stage.poses().size();
}

SettingCurve measure_rays(const BakeReader& bake, const Stage& stage,
                          const std::vector<uint32_t>& wanted,
                          const std::function<void()>& on_step) {
    const TransferTruth truth(bake);
    SettingCurve curve;
    curve.name = "rays";
    curve.title = "Rays a vertex";
    curve.axis = "rays a vertex";
    curve.logarithmic = true;
    curve.drawn = {"expected_noise", "stated_noise", "transfer_error"};
    curve.reference_name = fmt::format("{} rays", truth.rays());
    RayBakes bakes;
    std::vector<SettingSource> sources;
    for (const uint32_t rays : values_up_to(bake.identity().rays, wanted)) {
        Setting& setting = curve.settings.emplace_back();
        setting.value = rays;
        setting.all = rays == bake.identity().rays;
        RayBake* const other =
            bakes.emplace_back(std::make_unique<RayBake>(bake, options_with(bake, rays))).get();
        sources.push_back({[other](uint32_t p) { return other->pose(p); }, other->still()});
    }
    measure_settings(
        curve, sources, stage,
        [&](uint32_t p) {
            SettingReference reference = pictures_of_truth(truth, stage, p);
            on_step();
            return reference;
        },
        on_step);
    add_noise(bakes, curve);
    curve.explanation = explanation_of(stage, truth.rays(), bakes.front()->rays());
    return curve;
}

}  // namespace paim
