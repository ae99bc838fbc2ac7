// Views to frames.
#include "player/presenter.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "player/inspect/lobe.h"
#include "player/inspect/pick.h"
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

// Whether the end of the scale is the largest value that there is.
bool is_scaled_to_fit(SurfaceView view) {
    return view == SurfaceView::coefficient || is_error_view(view);
}

int divided_at(double split, int width) {
    return std::clamp(static_cast<int>(split * width), 0, width);
}

}  // namespace

Presenter::Presenter(std::shared_ptr<const Asset> asset, const Bounds& reach,
                     EnvironmentLight environment, const DecodeLimits& limits, Decoder decoder)
    : rig_(std::move(environment)), renderer_(asset, limits, decoder) {
    renderer_.set_environment(rig_.environment().image());
    asset_ = std::move(asset);
    reach_ = reach;
    colors_ = std::make_unique<SurfaceColors>(asset_);
    pose_bounds_.emplace(*asset_);
    path_.emplace(*asset_);
}

void Presenter::set_asset(std::shared_ptr<const Asset> asset, const Bounds& reach,
                          const DecodeLimits& limits) {
    renderer_.set_asset(asset, limits);
    colors_ = std::make_unique<SurfaceColors>(asset);
    pose_bounds_.emplace(*asset);
    path_.emplace(*asset);
    decoded_.clear();
    asset_ = std::move(asset);
    reach_ = reach;
    legend_.reset();
    scale_.reset();
}

void Presenter::set_environment(EnvironmentLight environment) {
    renderer_.set_environment(environment.image());
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

void Presenter::set_light(const ViewState& view) {
    rig_.set_orientation(view.light.orientation);
    rig_.set_environment_strength(static_cast<float>(view.light.strength));
    rig_.set_key_light(view.light.key_on ? std::optional(view.light.key) : std::nullopt);
}

Bounds Presenter::bounds(const ViewState& view, const std::vector<Instance>& instances) {
    Bounds bounds = pose_bounds_->at(time(view), view.limits.geometry_components);
    if (instances.size() > 1) bounds.extend(crowd_bounds(instances, reach_));
    return bounds;
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
    set_light(view);
    Frame frame;
    frame.time = time(view);
    frame.limits = limits;
    frame.light = rig_.coefficients(static_cast<int>(renderer_.most().bands));
    frame.edges = view.edges;
    frame.instances = crowd(view);
    frame.camera = camera(view);
    frame.bounds = bounds(view, frame.instances);
    frame.background = view.background;
    frame.environment_from_world = rig_.environment_from_world();
    frame.environment_strength = rig_.environment_strength();
    legend_.reset();
    if (view.surface == SurfaceView::lit) return frame;
    frame.background = kNeutral;
    frame.colors = [this, view, limits](double time) -> const PartColors& {
        return paint(view, limits, time);
    };
    return frame;
}

Presenter::ScaleKey Presenter::scale_key(const ViewState& view) {
    return {view.surface, view.coefficient, view.channel, view.limits};
}

void Presenter::set_color_light() {
    colors_->set_light(DistantLight(rig_.coefficients(static_cast<int>(renderer_.most().bands))));
}

const PartColors& Presenter::paint(const ViewState& view, const DecodeLimits& limits, double time) {
    const SurfaceQuery query{.view = view.surface,
                             .time = time,
                             .limits = limits,
                             .coefficient = view.coefficient,
                             .channel = view.channel};
    set_color_light();
    const ColoredSurface& surface =
        is_scaled_to_fit(view.surface) ? paint_scaled(view, query) : colors_->paint(query);
    if (!legend_) legend_ = surface.legend;  // that of the first copy
    return surface.colors;
}

// The first copy of a picture may make the scale larger, the others only that of the next picture.
const ColoredSurface& Presenter::paint_scaled(const ViewState& view, SurfaceQuery query) {
    if (!scale_ || scale_->key != scale_key(view)) {
        scale_ = {scale_key(view), scale_of_all(view, view.num_instances > 1), false};
    }
    query.scale = legend_ ? legend_->highest : scale_->highest;
    const ColoredSurface& surface = colors_->paint(query);
    const float largest = largest_value(surface);
    if (scale_->is_fixed || !(largest > scale_->highest)) return surface;
    scale_->highest = largest;
    if (legend_) return surface;
    query.scale = largest;
    return colors_->paint(query);
}

// The largest magnitude, over vertices that a face has.
float Presenter::largest_value(const ColoredSurface& surface) {
    float largest = 0.0f;
    for (size_t part = 0; part < surface.values.size(); ++part) {
        for (const uint32_t v : colors_->errors().counted(part)) {
            largest = std::max(largest, std::abs(surface.values[part][v]));
        }
    }
    return largest;
}

// Of all that a picture of this view shows, or all pictures; on both sides of a comparison.
float Presenter::scale_of_all(const ViewState& view, bool at_all_times) {
    SurfaceQuery query{.view = view.surface,
                       .time = time(view),
                       .limits = view.limits,
                       .coefficient = view.coefficient,
                       .channel = view.channel};
    const auto largest = [&] {
        return at_all_times ? colors_->sequence_scale(query) : colors_->paint(query).legend.highest;
    };
    const float limited = largest();
    if (view.comparison == Comparison::none) return limited;
    query.limits = renderer_.most();
    return std::max(limited, largest());
}

void Presenter::fix_scale(const ViewState& view) {
    if (!is_scaled_to_fit(view.surface)) return;
    set_light(view);
    set_color_light();
    scale_ = {scale_key(view), scale_of_all(view, true), true};
}

float Presenter::suitable_exposure_ev(const ViewState& view) {
    set_light(view);
    LimitErrors& errors = colors_->errors();
    errors.set_light(DistantLight(rig_.coefficients(static_cast<int>(renderer_.most().bands))));
    const Playback& playback = errors.play(time(view), view.limits);
    std::vector<std::span<const Vec3f>> radiance;
    for (size_t j = 0; j < playback.num_parts(); ++j) radiance.push_back(playback.radiance(j));
    return auto_exposure_ev(radiance);
}

const DecodedPose& Presenter::decoded(const ViewState& view, size_t part) {
    while (decoded_.size() < asset_->parts.size()) {
        decoded_.push_back({MeshDecoder(asset_->parts[decoded_.size()]), {}, {}, {}});
    }
    Decoded& decoded = decoded_[part];
    if (decoded.time == time(view) && decoded.limits == view.limits) return decoded.pose;
    decoded.decoder.decode(time(view), view.limits, decoded.pose);
    DecodedPose& pose = decoded.pose;
    move_to_scene(pose.root, pose.positions, pose.num_following);
    decoded.time = time(view);
    decoded.limits = view.limits;
    return pose;
}

std::optional<PickedVertex> Presenter::pick(const ViewState& view, float x, float y, float aspect) {
    if (view.comparison == Comparison::side_by_side) {
        // Each half is a picture of its own.
        aspect *= 0.5f;
        x = x < 0.5f ? 2.0f * x : 2.0f * x - 1.0f;
    }
    std::vector<PickSurface> surfaces;
    for (size_t j = 0; j < asset_->parts.size(); ++j) {
        surfaces.push_back({&asset_->parts[j].topology, decoded(view, j).positions});
    }
    const auto hit = player::pick(ray_through_pixel(camera(view), x, y, aspect), surfaces);
    if (!hit) return std::nullopt;
    return PickedVertex{hit->part, hit->vertex};
}

Vec3f Presenter::position_of(const ViewState& view, const PickedVertex& vertex) {
    const DecodedPose& pose = decoded(view, vertex.part);
    const size_t num_vertices = pose.positions.size() / 3;
    return {pose.positions[vertex.vertex], pose.positions[num_vertices + vertex.vertex],
            pose.positions[2 * num_vertices + vertex.vertex]};
}

std::vector<float> Presenter::transfer_of(const ViewState& view, const PickedVertex& vertex) {
    const DecodedPose& pose = decoded(view, vertex.part);
    const std::vector<float> local =
        vertex_transfer(pose.layout, pose.transfer, vertex.vertex, kLuminance);
    const bool follows = vertex.vertex < pose.num_following;
    if (!follows || !pose.root.turns()) return local;
    // As a light, whose three channels are the same.
    LightCoefficients function{static_cast<int>(pose.layout.in_bands), {}};
    for (const float value : local) function.values.emplace_back(Vec3f::Constant(value));
    function = turn(function, pose.root.rotation.toRotationMatrix());
    std::vector<float> in_scene;
    for (const Vec3f& value : function.values) in_scene.push_back(value.x());
    return in_scene;
}

VertexHistory Presenter::history(const ViewState& view, SurfaceView error_view) {
    set_light(view);
    LimitErrors& errors = colors_->errors();
    errors.set_light(DistantLight(rig_.coefficients(static_cast<int>(renderer_.most().bands))));
    return {errors, error_of(error_view), view.picked->part, view.picked->vertex, view.limits};
}

void Presenter::draw(const ViewState& view, const gl::Target& target) {
    target.bind();
    const int width = target.width(), height = target.height();
    const auto aspect_of = [&](int columns) {
        return static_cast<float>(std::max(1, columns)) / static_cast<float>(height);
    };
    const auto displayed = [&](Frame frame) {
        if (target.kind() == gl::TargetKind::display) frame.display = tone_curve(view);
        return frame;
    };
    const Frame limited = displayed(frame(view, view.limits));
    if (view.comparison == Comparison::none) return renderer_.draw(limited, aspect_of(width));
    const Frame whole = displayed(frame(view, renderer_.most()));
    const bool wipe = view.comparison == Comparison::wipe;
    const int middle = wipe ? divided_at(view.split, width) : width / 2;
    glEnable(GL_SCISSOR_TEST);
    const auto draw_columns = [&](const Frame& shown, int first, int last) {
        if (first == last) return;
        glScissor(first, 0, last - first, height);
        if (!wipe) glViewport(first, 0, last - first, height);
        renderer_.draw(shown, aspect_of(wipe ? width : last - first));
    };
    draw_columns(limited, 0, middle);
    draw_columns(whole, middle, width);
    glDisable(GL_SCISSOR_TEST);
}

Image Presenter::render(const ViewState& view, int width, int height, int samples) {
    const Frame limited = frame(view, view.limits);
    if (view.comparison == Comparison::none) {
        return renderer_.render(limited, width, height, samples);
    }
    const Frame whole = frame(view, renderer_.most());
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
