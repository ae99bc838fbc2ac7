// Views to frames.
#include "player/presenter.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "paim/codec/playback.h"
#include "player/gl/scissor.h"
#include "player/light/auto_exposure.h"
#include "player/view/crowd.h"
#include "player/view/framing.h"

namespace paim::player {

namespace {

// Behind colours that stand for numbers.
const Background kNeutral{Background::Kind::color, Vec3f::Constant(0.03f)};

Image columns(const Image& image, int first, int last) {
    Image part(last - first, image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = first; x < last; ++x) part.at(x - first, y) = image.at(x, y);
    }
    return part;
}

void copy_columns(const Image& from, int first, Image& to) {
    for (int y = 0; y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x) to.at(first + x, y) = from.at(x, y);
    }
}

int divided_at(double split, int width) {
    return std::clamp(static_cast<int>(split * width), 0, width);
}

}  // namespace

Presenter::Presenter(std::shared_ptr<const Asset> asset, const Bounds& reach,
                     EnvironmentLight environment, const DecodeLimits& limits,
                     const DecodeLimits& fewer, Decoder decoder)
    : rig_(std::move(environment)), renderer_(asset, limits, fewer, decoder) {
    renderer_.set_environment(rig_.environment());
    show(std::move(asset), reach);
}

void Presenter::set_asset(std::shared_ptr<const Asset> asset, const Bounds& reach,
                          const DecodeLimits& limits, const DecodeLimits& fewer) {
    renderer_.set_asset(asset, limits, fewer);
    show(std::move(asset), reach);
}

// What refers to the asset before goes first.
void Presenter::show(std::shared_ptr<const Asset> asset, const Bounds& reach) {
    limited_bounds_.emplace(*asset);
    whole_bounds_.emplace(*asset);
    path_.emplace(*asset);
    painter_ = std::make_unique<ColorPainter>(asset);
    probe_ = std::make_unique<VertexProbe>(asset);
    asset_ = std::move(asset);
    reach_ = reach;
}

void Presenter::set_environment(EnvironmentLight environment) {
    renderer_.set_environment(environment);
    rig_.set_environment(std::move(environment));
}

ToneCurve Presenter::tone_curve(const ViewState& view) {
    return view.surface == SurfaceView::lit ? view.tone_curve : ToneCurve{};
}

double Presenter::time(const ViewState& view) const {
    return shown_time(view.animation, asset_->num_poses());
}

Vec3d Presenter::camera_origin(const ViewState& view) {
    return view.camera.target == CameraTarget::pose ? path_->at(time(view)) : Vec3d::Zero();
}

Camera Presenter::camera(const ViewState& view) {
    return view.camera.orbit.camera(camera_origin(view));
}

OrbitCamera Presenter::framed(const ViewState& view, float aspect, bool pose_alone) {
    const auto azimuth_rad = static_cast<float>(view.camera.orbit.azimuth_rad);
    const auto elevation_rad = static_cast<float>(view.camera.orbit.elevation_rad);
    BodyPath* const path = view.camera.target == CameraTarget::pose ? &*path_ : nullptr;
    Camera camera = pose_alone
                        ? frame_pose(*asset_, time(view), azimuth_rad, elevation_rad, aspect, path)
                        : frame_asset(*asset_, azimuth_rad, elevation_rad, aspect, path);
    if (view.num_instances > 1 && !pose_alone && path == nullptr) {
        FrustumFit fit(azimuth_rad, elevation_rad, aspect);
        for (const Instance& instance :
             make_crowd(view.num_instances, reach_, asset_->num_poses())) {
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3f point((corner & 1 ? reach_.upper : reach_.lower).x(),
                                  (corner & 2 ? reach_.upper : reach_.lower).y(),
                                  (corner & 4 ? reach_.upper : reach_.lower).z());
                fit.add(point.cast<double>() + instance.offset);
            }
        }
        camera = fit.camera();
    }
    OrbitCamera orbit = OrbitCamera::of(camera);
    orbit.azimuth_rad = view.camera.orbit.azimuth_rad;
    orbit.elevation_rad = view.camera.orbit.elevation_rad;
    return orbit;
}

const LightCoefficients& Presenter::light_of(const ViewState& view) {
    rig_.set_orientation(view.light.orientation);
    rig_.set_environment_strength(static_cast<float>(view.light.strength));
    rig_.set_key_light(view.light.key_on ? std::optional(view.light.key) : std::nullopt);
    return rig_.coefficients(static_cast<int>(renderer_.most().bands));
}

// Each copy plays as the view says: over again or there and back, with or without moments between poses.
std::vector<Instance> Presenter::crowd(const ViewState& view) const {
    const uint32_t num_poses = asset_->num_poses();
    std::vector<Instance> crowd = make_crowd(view.num_instances, reach_, num_poses);
    for (Instance& copy : crowd) {
        if (copy.time_offset == 0.0) continue;
        Animation own = view.animation;
        own.playing = true;
        own.speed = 1.0;
        advance(own, num_poses, 1.0, copy.time_offset);
        copy.time_offset = shown_time(own, num_poses) - time(view);
    }
    return crowd;
}

Frame Presenter::frame(const ViewState& view, const DecodeLimits& limits) {
    Frame frame;
    frame.time = time(view);
    frame.limits = limits;
    frame.light = light_of(view);
    frame.gloss = view.gloss;
    frame.textures = view.textures;
    frame.edges = view.edges;
    frame.instances = crowd(view);
    frame.camera = camera(view);
    PoseBoundsCache& bounds = limits == view.limits ? *limited_bounds_ : *whole_bounds_;
    frame.bounds = bounds.at(frame.time, limits.geometry_components);
    if (frame.instances.size() > 1) frame.bounds.extend(crowd_bounds(frame.instances, reach_));
    frame.background = view.background;
    frame.environment_from_world = rig_.environment_from_world();
    frame.environment_strength = rig_.environment_strength();
    if (!is_painted(view)) return frame;
    frame.background = kNeutral;
    frame.colors = [this, limits](double time) -> const PartColors& {
        return painter_->paint(time, limits);
    };
    return frame;
}

void Presenter::fix_scale(const ViewState& view) {
    painter_->fix_scale(view, light_of(view), renderer_.most());
}

float Presenter::suitable_exposure_ev(const ViewState& view) {
    Playback playback(asset_);
    playback.set_light(DistantLight(light_of(view)));
    playback.update(time(view), view.limits);
    std::vector<std::span<const Vec3f>> radiance;
    for (size_t j = 0; j < playback.num_parts(); ++j) radiance.push_back(playback.radiance(j));
    return auto_exposure_ev(radiance);
}

std::optional<PickedVertex> Presenter::pick(const ViewState& view, float x, float y, float aspect) {
    if (view.comparison == Comparison::side_by_side) {
        // Each half is a picture of its own.
        aspect *= 0.5f;
        x = x < 0.5f ? 2.0f * x : 2.0f * x - 1.0f;
    }
    return probe_->pick(time(view), view.limits, camera(view), x, y, aspect);
}

// Both sides of a comparison, or the one that is shown.
std::vector<Frame> Presenter::frames(const ViewState& view) {
    if (is_painted(view)) painter_->begin(view, time(view), light_of(view), renderer_.most());
    std::vector<Frame> frames{frame(view, view.limits)};
    if (view.comparison != Comparison::none) frames.push_back(frame(view, renderer_.most()));
    return frames;
}

void Presenter::draw(const ViewState& view, const gl::Target& target) {
    target.bind();
    const int width = target.width(), height = target.height();
    const auto aspect_of = [&](int columns) {
        return static_cast<float>(std::max(1, columns)) / static_cast<float>(height);
    };
    std::vector<Frame> sides = frames(view);
    if (target.kind() == gl::TargetKind::display) {
        for (Frame& side : sides) side.display = tone_curve(view);
    }
    if (sides.size() == 1) return renderer_.draw(sides.front(), aspect_of(width));
    const bool wipe = view.comparison == Comparison::wipe;
    const int middle = wipe ? divided_at(view.split, width) : width / 2;
    const gl::Scissor scissor;
    const auto draw_columns = [&](const Frame& shown, int first, int last) {
        if (first == last) return;
        glScissor(first, 0, last - first, height);
        if (!wipe) glViewport(first, 0, last - first, height);
        renderer_.draw(shown, aspect_of(wipe ? width : last - first));
    };
    draw_columns(sides[0], 0, middle);
    draw_columns(sides[1], middle, width);
}

Image Presenter::render(const ViewState& view, int width, int height, int samples) {
    const std::vector<Frame> sides = frames(view);
    if (sides.size() == 1) return renderer_.render(sides.front(), width, height, samples);
    const Frame &limited = sides[0], &whole = sides[1];
    Image picture(width, height);
    if (view.comparison == Comparison::side_by_side && width > 1) {
        const int middle = width / 2;
        copy_columns(renderer_.render(limited, middle, height, samples), 0, picture);
        copy_columns(renderer_.render(whole, width - middle, height, samples), middle, picture);
        return picture;
    }
    const int middle = divided_at(view.split, width);
    picture = renderer_.render(limited, width, height, samples);
    const Image right = renderer_.render(whole, width, height, samples);
    copy_columns(columns(right, middle, width), middle, picture);
    return picture;
}

}  // namespace paim::player
