// Options to views.
#include "player/start_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "paim/base/error.h"
#include "player/render/lower_limits.h"
#include "player/view/view_file.h"

namespace paim::player {

namespace {

void change(const Options& options, ViewState& view) {
    for (const auto& change : options.view_changes) change(view);
    if (options.target) view.camera.target = options.target->target;
    if (!options.camera) return;
    view.camera.orbit.azimuth_rad = options.camera->azimuth_rad;
    view.camera.orbit.elevation_rad = options.camera->elevation_rad;
}

// Cameras are of floats: one that is far away stands on what it looks at.
void require_usable(const OrbitCamera& orbit, const Options& options) {
    const Camera camera = orbit.camera();
    const bool usable = camera.eye.allFinite() && camera.target.allFinite() &&
                        (camera.eye - camera.target).norm() > 0.0f;
    if (usable) return;
    if (!options.target && options.view_path) {
        throw_bad_input("{}: camera.place and camera.distance: not within numbers of 32 bits",
                        options.view_path->string());
    }
    throw_usage(
        "--camera-target: expected a point near the model, got one beyond numbers of 32 bits");
}

}  // namespace

void frame_as_asked(const Options& options, const SceneUnits& units, Presenter& presenter,
                    float aspect, ViewState& view) {
    OrbitCamera& orbit = view.camera.orbit;
    const Vec3d place = orbit.target;
    orbit = presenter.framed(view, aspect, false);
    if (options.camera) orbit.distance *= options.camera->distance_factor;
    if (view.camera.target != CameraTarget::point) return;
    // That of the option, or else that of the view file.
    orbit.target = options.target ? units.to_model(options.target->point) : place;
}

ViewState start_view(const Options& options, const Scene& scene, Presenter& presenter,
                     float aspect) {
    ViewState view;
    change(options, view);
    frame_as_asked(options, scene.units, presenter, aspect, view);
    if (options.view_path) {
        read_view(*options.view_path, scene.units, view);
        change(options, view);
        if (options.camera || options.target)
            frame_as_asked(options, scene.units, presenter, aspect, view);
    }
    view.limits = lower_of(view.limits, options.limits);
    view.limits.bands = std::max(1u, view.limits.bands);
    const uint32_t num_coefficients = view.limits.bands * view.limits.bands;
    if (view.coefficient >= num_coefficients) {
        fmt::print(stderr, "paim-play: note: coefficient {}: there are {}, showing the last\n",
                   view.coefficient, num_coefficients);
        view.coefficient = num_coefficients - 1;
    }
    view.animation.time =
        std::min(view.animation.time, static_cast<double>(scene.asset->num_poses()) - 1.0);
    require_usable(view.camera.orbit, options);
    if (options.auto_exposure) {
        view.tone_curve.exposure_ev = presenter.suitable_exposure_ev(view);
    }
    return view;
}

Presenter make_presenter(const Options& options, const Scene& scene) {
    return {scene.asset,    scene.bounds,   scene.environment,
            options.limits, options.limits, options.decoder};
}

}  // namespace paim::player
