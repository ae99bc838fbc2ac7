// One table of everything in a view that a view file holds: its name there, its range and where it is.
// Writing and reading walk this table, so that they cannot disagree.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "player/light/auto_exposure.h"
#include "player/view/view_state.h"

namespace paim::player {

// Words that stand for values, for files and the command line.
template <typename Value>
using Names = std::vector<std::pair<std::string, Value>>;

Names<CameraTarget> camera_target_names();
Names<Comparison> comparison_names();
Names<Background::Kind> background_names();
Names<SurfaceView> surface_view_names();
Names<GlossDetail> gloss_detail_names();

// Calls a function of the visitor for each field of the view. Names are paths: "light.yaw_deg".
//   numbers   visit.number(name, value, lowest, highest): double or float
//   counts    visit.count(name, value, lowest, highest): uint32_t
//   switches  visit.flag(name, value)
//   vectors   visit.vector(name, value, lowest, highest): three numbers
//   words     visit.word(name, value, names)
template <typename View, typename Visitor>
void visit_fields(View& view, Visitor&& visit) {
    constexpr double kFar = 1e38;
    constexpr uint32_t kMost = std::numeric_limits<uint32_t>::max();
    visit.number("animation.time", view.animation.time, 0.0, 1e9);
    visit.number("animation.speed", view.animation.speed, -kMaxSpeed, kMaxSpeed);
    visit.flag("animation.playing", view.animation.playing);
    visit.flag("animation.ping_pong", view.animation.ping_pong);
    visit.flag("animation.in_betweens", view.animation.in_betweens);
    visit.count("detail.geometry_components", view.limits.geometry_components, 0, kMost);
    visit.count("detail.transfer_components", view.limits.transfer_components, 0, kMost);
    visit.count("detail.vertex_components", view.limits.vertex_components, 0, kMost);
    visit.count("detail.bands", view.limits.bands, 1, kMost);
    visit.number("light.yaw_deg", view.light.orientation.yaw_deg, -kMaxAngle_deg, kMaxAngle_deg);
    visit.number("light.pitch_deg", view.light.orientation.pitch_deg, -kMaxAngle_deg,
                 kMaxAngle_deg);
    visit.number("light.roll_deg", view.light.orientation.roll_deg, -kMaxAngle_deg, kMaxAngle_deg);
    visit.flag("light.turning", view.light.turning);
    visit.number("light.turn_speed_deg", view.light.turn_speed_deg, -kMaxTurnSpeed_deg,
                 kMaxTurnSpeed_deg);
    visit.number("light.strength", view.light.strength, 0.0, kMaxStrength);
    visit.flag("key_light.on", view.light.key_on);
    visit.number("key_light.azimuth_deg", view.light.key.azimuth_deg, -360.0, 360.0);
    visit.number("key_light.elevation_deg", view.light.key.elevation_deg, -90.0, 90.0);
    visit.number("key_light.angular_diameter_deg", view.light.key.angular_diameter_deg,
                 KeyLight::kMinDiameter_deg, KeyLight::kMaxDiameter_deg);
    visit.number("key_light.strength", view.light.key.strength, 0.0, kMaxStrength);
    visit.vector("key_light.color", view.light.key.color, 0.0, kMaxStrength);
    visit.word("camera.target", view.camera.target, camera_target_names());
    visit.vector("camera.place", view.camera.orbit.target, -kFar, kFar);
    visit.number("camera.distance", view.camera.orbit.distance, 1e-38, kFar);
    visit.number("camera.azimuth_rad", view.camera.orbit.azimuth_rad, -7.0, 7.0);
    visit.number("camera.elevation_rad", view.camera.orbit.elevation_rad, -1.56, 1.56);
    visit.number("camera.turn_speed_deg", view.camera.turn_speed_deg, -kMaxTurnSpeed_deg,
                 kMaxTurnSpeed_deg);
    visit.number("display.exposure_ev", view.tone_curve.exposure_ev, -double{kLargestExposure_ev},
                 double{kLargestExposure_ev});
    visit.number("display.gamma", view.tone_curve.gamma, 0.0, double{kHighestGamma});
    visit.word("display.tone_map", view.tone_curve.tone_operator, tone_operator_names());
    visit.word("background.kind", view.background.kind, background_names());
    visit.vector("background.color", view.background.color, 0.0, 1.0);
    visit.word("surface.view", view.surface, surface_view_names());
    visit.count("surface.coefficient", view.coefficient, 0, kMaxCoefficient);
    visit.count("surface.channel", view.channel, 0, kLuminance);
    visit.word("surface.gloss", view.gloss, gloss_detail_names());
    visit.flag("surface.textures", view.textures);
    visit.flag("surface.edges", view.edges);
    visit.word("comparison.kind", view.comparison, comparison_names());
    visit.number("comparison.split", view.split, 0.0, 1.0);
    visit.count("instances", view.num_instances, 1, kMostInstances);
}

}  // namespace paim::player
