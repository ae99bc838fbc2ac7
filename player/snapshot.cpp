// --snapshot.
#include "player/snapshot.h"

#include <fmt/format.h>

#include <algorithm>

#include "paim/base/json_text.h"
#include "paim/image/exr.h"
#include "paim/image/png.h"
#include "player/gl/headless_context.h"
#include "player/render/scene_renderer.h"
#include "player/report.h"

namespace paim::player {

namespace {

constexpr int kDefaultSamples = 2;

// A note where a bright light leaves little but white.
void warn_if_clipped(const Image& image, const ToneCurve& curve) {
    constexpr double kMuch = 0.25;
    const float white = curve.white();
    const auto clipped =
        std::count_if(image.pixels.begin(), image.pixels.end(),
                      [&](const Vec3f& pixel) { return pixel.maxCoeff() > white; });
    const double share = static_cast<double>(clipped) / static_cast<double>(image.pixels.size());
    if (share <= kMuch) return;
    fmt::print(stderr,
               "note: {:.0f} % of the picture is brighter than white; try --exposure {:.1f}\n",
               100.0 * share, suggested_exposure_ev(image));
}

}  // namespace

void take_snapshot(const Options& options, const Scene& scene) {
    const auto context = gl::make_headless_context();
    const int samples = options.supersample.value_or(kDefaultSamples);
    SceneRenderer renderer(*scene.asset, scene.environment, options.limits);
    const Image image = renderer.render(first_frame(options, scene), options.size.first,
                                        options.size.second, samples);
    const auto& path = *options.snapshot_path;
    if (path.extension() == ".exr") {
        write_exr(path, image);
    } else {
        write_png(path, image, options.tone_curve);
        warn_if_clipped(image, options.tone_curve);
    }
    if (!options.json) return;
    nlohmann::ordered_json json =
        describe_frame(options, scene, renderer, context->description(), samples);
    json["snapshot"] = path.string();
    json["pose"] = options.pose;
    json["env_rotation_deg"] = options.env_rotation_rad * 180.0 / kPi;
    json["exposure_ev"] = options.tone_curve.exposure_ev;
    json["tone_map"] = tone_operator_name(options.tone_curve.tone_operator);
    json["gamma"] = options.tone_curve.gamma;
    fmt::print("{}\n", json_text(json, 2));
}

}  // namespace paim::player
