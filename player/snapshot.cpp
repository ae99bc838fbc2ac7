// --snapshot.
#include "player/snapshot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paim/base/json_text.h"
#include "paim/image/exr.h"
#include "paim/image/png.h"
#include "player/gl/headless_context.h"
#include "player/report.h"
#include "player/start_view.h"
#include "player/view/view_file.h"

namespace paim::player {

namespace {

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

// What the colours of the surface mean.
void describe_legend(const Legend& legend, nlohmann::ordered_json& json) {
    json["surface"] = legend.title;
    if (legend.kind != ScaleKind::none) {
        json["scale_lowest"] = legend.lowest;
        json["scale_highest"] = legend.highest;
    }
    if (legend.worst) {
        json["worst_part"] = legend.worst->part;
        json["worst_vertex"] = legend.worst->vertex;
        json["worst_error"] = legend.worst->value;
    }
    if (legend.mean_error) json["mean_error"] = *legend.mean_error;
    if (!legend.note.empty()) json["surface_note"] = legend.note;
}

}  // namespace

void take_snapshot(const Options& options, const Scene& scene) {
    const auto context = gl::make_headless_context();
    const int samples = options.file_samples();
    const auto [width, height] = options.size;
    Presenter presenter = make_presenter(options, scene);
    const ViewState view = start_view(options, scene, presenter,
                                      static_cast<float>(width) / static_cast<float>(height));
    const Image image = presenter.render(view, width, height, samples);
    const ToneCurve curve = Presenter::tone_curve(view);
    const auto& path = *options.snapshot_path;
    if (path.extension() == ".exr") {
        write_exr(path, image);
    } else {
        write_png(path, image, curve);
        if (view.surface == SurfaceView::lit) warn_if_clipped(image, curve);
    }
    if (options.save_view_path) write_view(*options.save_view_path, view, scene.units);
    if (!options.json) return;
    nlohmann::ordered_json json =
        describe_picture(options, scene, presenter, view, context->description(), samples);
    json["snapshot"] = path.string();
    json["pose"] = view.animation.time;
    json["env_rotation_deg"] = view.light.orientation.yaw_deg;
    json["exposure_ev"] = view.tone_curve.exposure_ev;
    json["gamma"] = view.tone_curve.gamma;
    json["tone_map"] = tone_operator_name(view.tone_curve.tone_operator);
    const Legend* const legend = presenter.painter().legend();
    if (legend != nullptr) describe_legend(*legend, json);
    fmt::print("{}\n", json_text(json, 2));
}

}  // namespace paim::player
