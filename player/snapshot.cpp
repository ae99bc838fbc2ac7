// --snapshot.
#include "player/snapshot.h"

#include <fmt/format.h>

#include "paim/image/exr.h"
#include "paim/image/png.h"
#include "player/gl/headless_context.h"
#include "player/render/scene_renderer.h"
#include "player/report.h"

namespace paim::player {

namespace {

constexpr int kDefaultSamples = 2;

}  // namespace

void take_snapshot(const Options& options, const Scene& scene) {
    const auto context = gl::make_headless_context();
    const int samples = options.supersample.value_or(kDefaultSamples);
    SceneRenderer renderer(scene.model, scene.environment, options.limits);
    const Image image = renderer.render(first_frame(options, scene), options.size.first,
                                        options.size.second, samples);
    const auto& path = *options.snapshot_path;
    if (path.extension() == ".exr") {
        write_exr(path, image);
    } else {
        write_png(path, image, options.tone_curve);
    }
    if (!options.json) return;
    nlohmann::ordered_json json = describe_frame(options, scene, context->description(), samples);
    json["snapshot"] = path.string();
    json["pose"] = options.pose;
    json["env_rotation_deg"] = options.env_rotation_rad * 180.0 / kPi;
    json["exposure_ev"] = options.tone_curve.exposure_ev;
    json["gamma"] = options.tone_curve.gamma;
    fmt::print("{}\n", json.dump(2));
}

}  // namespace paim::player
