// The window's loop.
#include "player/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/error.h"
#include "paim/image/exr.h"
#include "paim/image/png.h"
#include "player/gl/check.h"
#include "player/ui/recent_files.h"
#include "player/view/framing.h"
#include "player/view/view_file.h"

namespace paim::player {

namespace {

constexpr double kMessageSeconds = 6.0;
constexpr double kIdleWaitSeconds = 0.1;  // at most, between looks at what has happened
constexpr int kSettlingFrames = 3;

}  // namespace

App::App(const Options& options, Scene scene, std::unique_ptr<PrefixLoader> loader)
    : options_(options), window_(options.size.first, options.size.second, "paim-play") {
    session_ = std::make_unique<Session>(options, std::move(scene), std::move(loader), aspect());
    listen();
    imgui_.emplace(window_);
    panels_.recent = read_recent_files();
    window_.set_title(session_->model_path().filename().string() + " - paim-play");
}

void App::run() {
    for (int i = 0; !window_.should_close() && i != options_.window_frames.value_or(-1); ++i) {
        step();
    }
    if (options_.save_view_path) {
        write_view(*options_.save_view_path, session_->view, session_->units());
    }
}

bool App::step() {
    // Frames that were asked for by number are not waited for.
    const bool waits = redraws_ == 0 && !is_moving() && !options_.window_frames;
    window_.poll(waits || !is_visible() ? kIdleWaitSeconds : 0.0);
    const auto now = Clock::now();
    const double elapsed_s =
        std::chrono::duration<double>(now - std::exchange(last_step_, now)).count();
    std::string message;
    if (session_->take_more(aspect(), message)) redraws_ = kSettlingFrames;
    if (!message.empty()) say(message);
    if (clip_) {
        record_next();
    } else {
        advance(session_->view, session_->range().num_poses,
                double{session_->asset().frames_per_second}, elapsed_s);
    }
    follow_history();
    const bool message_ends = !message_.empty() && now >= message_end_;
    if (message_ends) message_.clear();
    const bool draws = is_visible() && (redraws_ > 0 || message_ends || drawn_ != session_->view ||
                                        options_.window_frames || !session_->loading().empty());
    if (draws) draw();
    session_->read_on();
    return draws;
}

bool App::is_moving() const {
    const ViewState& view = session_->view;
    const bool plays =
        view.animation.playing && view.animation.speed != 0.0 && session_->range().num_poses > 1;
    return plays || (view.light.turning && view.light.turn_speed_deg != 0.0) ||
           view.camera.turn_speed_deg != 0.0 || clip_ || (history_ && !history_->values.done());
}

void App::listen() {
    gl::WindowEvents& events = window_.events();
    events.on_any = [this] { redraws_ = kSettlingFrames; };
    events.on_key = [this](int key, bool shift) {
        if (imgui_->wants_text()) return;
        const KeyBinding* const binding = find_key(key, shift);
        if (binding == nullptr) return;
        if (binding->change != nullptr) binding->change(session_->view, session_->range());
        carry_out(binding->command);
    };
    events.on_drag = [this](gl::MouseButton button, bool ctrl, double dx, double dy) {
        if (imgui_->wants_mouse()) return;
        const double x = dx / window_.height(), y = dy / window_.height();
        ViewState& view = session_->view;
        if (ctrl) {
            const Eigen::Matrix3f axes = session_->presenter().camera(view).axes();
            view.light.orientation = drag(view.light.orientation, axes, x, y);
            return;
        }
        session_->camera_moved();
        if (button == gl::MouseButton::left) {
            view.camera.orbit.orbit(x, y);
        } else {
            view.camera.orbit.pan(x, y);
        }
    };
    events.on_scroll = [this](double steps) {
        if (imgui_->wants_mouse()) return;
        session_->camera_moved();
        session_->view.camera.orbit.zoom(steps);
    };
    events.on_click = [this](double x, double y) {
        if (!imgui_->wants_mouse()) pick(x, y);
    };
    events.on_drop = [this](const auto& paths) {
        for (const auto& path : paths) open(path);
    };
}

void App::carry_out(WindowCommand command) {
    switch (command) {
        case WindowCommand::none:
            break;
        case WindowCommand::frame_all:
            session_->frame(aspect(), false);
            break;
        case WindowCommand::frame_pose:
            session_->camera_moved();
            session_->frame(aspect(), true);
            break;
        case WindowCommand::follow_body:
            session_->follow_body(session_->view.camera.target != CameraTarget::pose);
            break;
        case WindowCommand::auto_exposure:
            session_->view.tone_curve.exposure_ev =
                session_->presenter().suitable_exposure_ev(session_->view);
            break;
        case WindowCommand::snapshot_png:
            save_picture(".png");
            break;
        case WindowCommand::snapshot_exr:
            save_picture(".exr");
            break;
        case WindowCommand::save_view:
            save_view();
            break;
        case WindowCommand::open_file:
            panels_.show_open = !panels_.show_open;
            panels_.folder.clear();
            break;
        case WindowCommand::record:
            record();
            break;
        case WindowCommand::full_screen:
            window_.set_full_screen(!window_.is_full_screen());
            break;
        case WindowCommand::toggle_panels:
            panels_.show_panels = !panels_.show_panels;
            break;
        case WindowCommand::toggle_help:
            panels_.show_help = !panels_.show_help;
            break;
        case WindowCommand::quit:
            window_.close();
            break;
    }
}

void App::open(const std::filesystem::path& path) {
    try {
        history_.reset();
        say(session_->open(path, aspect()));
        clip_.reset();
        window_.set_title(session_->model_path().filename().string() + " - paim-play");
        panels_.recent = add_recent_file(path);
    } catch (const Error& error) {
        say(error.what());
    }
}

std::string App::message() const {
    return message_;
}

void App::say(const std::string& message) {
    message_ = message;
    message_end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(kMessageSeconds));
    redraws_ = kSettlingFrames;
}

bool App::is_visible() const {
    const auto [width, height] = window_.framebuffer_size();
    return !window_.is_minimised() && width > 0 && height > 0;
}

float App::aspect() const {
    const auto [width, height] = window_.framebuffer_size();
    return static_cast<float>(std::max(1, width)) / static_cast<float>(std::max(1, height));
}

void App::draw() {
    const auto [width, height] = window_.framebuffer_size();
    const auto start = Clock::now();
    redraws_ = std::max(0, redraws_ - 1);
    draw_picture(width, height);
    const PanelInfo info = panel_info();
    drawn_ = session_->view;
    imgui_->begin_frame();
    const PanelRequests requests = draw_panels(info, session_->range(), panels_, session_->view);
    window_.bind();
    imgui_->end_frame();
    gl::check_errors("drawing");
    window_.swap();
    const double frame_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    frame_ms_ += (frame_ms_ == 0.0 ? 1.0 : 0.1) * (frame_ms - frame_ms_);
    for (const WindowCommand command : requests.commands) carry_out(command);
    if (requests.open) open(*requests.open);
}

void App::draw_picture(int width, int height) {
    const int samples =
        samples_that_fit(width, height, options_.window_samples(), gl::max_target_size());
    if (!target_ || target_->width() != width * samples || target_->height() != height * samples) {
        target_.emplace(width * samples, height * samples);
    }
    session_->presenter().draw(session_->view, *target_);
    window_.bind();
    tone_mapper_.draw(*target_, samples, Presenter::tone_curve(session_->view));
}

PanelInfo App::panel_info() {
    PanelInfo info;
    const CodedMesh& mesh = session_->asset().moving();
    const SceneRenderer& renderer = session_->presenter().renderer();
    info.title = session_->model_path().filename().string();
    info.environment = session_->environment_name();
    info.renderer = renderer_name_;
    info.decoder = renderer.decodes_on_cpu() ? "vertices are decoded by the CPU"
                                             : "vertices are decoded in shaders";
    info.message = message_;
    info.loading = session_->loading();
    info.file_bytes = session_->file_bytes();
    info.texture_bytes = renderer.texture_bytes();
    info.buffer_bytes = renderer.buffer_bytes();
    info.num_vertices = mesh.topology.num_vertices;
    info.num_triangles = static_cast<uint32_t>(mesh.topology.triangles.size());
    info.frame_ms = frame_ms_;
    info.poses_per_second = session_->asset().frames_per_second;
    const auto* words = words_of_codec(mesh.transfer->codec_name());
    if (words != nullptr) info.vertex_components = words->components;
    if (clip_) {
        info.recorded =
            static_cast<float>(clip_->num_written()) / static_cast<float>(clip_->num_frames());
    }
    if (panels_.show_panels) describe_view(info);
    return info;
}

void App::describe_view(PanelInfo& info) {
    Presenter& presenter = session_->presenter();
    const ViewState& view = session_->view;
    info.accuracy = session_->accuracy();
    if (session_->accuracy_meter().stated()) info.stated = &*session_->accuracy_meter().stated();
    const Camera camera = presenter.camera(view);
    globe_.update(presenter.light(), camera.axes(), static_cast<int>(view.limits.bands),
                  view.tone_curve);
    info.globe_light = &globe_.light();
    info.globe_reconstruction = &globe_.reconstruction();
    info.negative_share = globe_.negative_share();
    info.legend = presenter.legend();
    if (info.legend != nullptr && info.legend->worst && info.legend->worst->value > 0.0f) {
        info.worst = place_of(info.legend->worst->part, info.legend->worst->vertex);
    }
    const int bands = static_cast<int>(session_->range().limits.bands);
    if (view.surface == SurfaceView::coefficient) {
        if (!coefficient_lobe_ || coefficient_lobe_->bands() != bands) {
            coefficient_lobe_.emplace(bands);
        }
        std::vector<float> coefficients(view.coefficient + 1, 0.0f);
        coefficients.back() = 1.0f;
        coefficient_lobe_->update(coefficients, camera);
        info.coefficient_lobe = &coefficient_lobe_->texture();
    }
    if (view.picked) describe_picked(info);
}

void App::describe_picked(PanelInfo& info) {
    Presenter& presenter = session_->presenter();
    const ViewState& view = session_->view;
    const int bands = static_cast<int>(session_->range().limits.bands);
    if (!picked_lobe_ || picked_lobe_->bands() != bands) picked_lobe_.emplace(bands);
    picked_lobe_->update(presenter.transfer_of(view, *view.picked), presenter.camera(view));
    info.picked = PickedInfo{*view.picked, &picked_lobe_->texture(), {}, {}, 0};
    info.picked_place = place_of(view.picked->part, view.picked->vertex);
    if (!history_) return;
    info.picked->history_title = std::string(row_of(history_->surface).words);
    info.picked->history = history_->values.values();
    info.picked->num_poses = history_->values.times().size();
}

std::optional<PicturePlace> App::place_of(uint32_t part, uint32_t vertex) {
    Presenter& presenter = session_->presenter();
    const ViewState& view = session_->view;
    if (view.comparison == Comparison::side_by_side) return std::nullopt;
    const std::optional<Vec3f> place =
        project(presenter.camera(view), aspect(), presenter.position_of(view, {part, vertex}));
    if (!place) return std::nullopt;
    return PicturePlace{place->x(), place->y()};
}

void App::pick(double x, double y) {
    session_->view.picked = session_->presenter().pick(session_->view, static_cast<float>(x),
                                                       static_cast<float>(y), aspect());
}

// Some poses of the history of the picked vertex at every step, so that the window stays alive.
void App::follow_history() {
    constexpr std::chrono::milliseconds kShare(8);
    const ViewState& view = session_->view;
    if (!view.picked) {
        history_.reset();
        return;
    }
    const SurfaceView surface =
        is_error_view(view.surface) ? view.surface : SurfaceView::transfer_error;
    if (!history_ || history_->vertex != *view.picked || history_->surface != surface ||
        history_->limits != view.limits) {
        history_.emplace(History{*view.picked, surface, view.limits,
                                 session_->presenter().history(view, surface)});
    }
    if (history_->values.done()) return;
    history_->values.advance(kShare);
    redraws_ = std::max(redraws_, 1);
}

void App::save_picture(const char* extension) {
    try {
        if (!is_visible()) return;
        const auto [width, height] = window_.framebuffer_size();
        const int samples = options_.file_samples();
        const Image image = session_->presenter().render(session_->view, width, height, samples);
        const std::filesystem::path path = free_name(extension);
        if (path.extension() == ".exr") {
            write_exr(path, image);
        } else {
            write_png(path, image, Presenter::tone_curve(session_->view));
        }
        say("saved " + path.string());
    } catch (const Error& error) {
        say(error.what());
    }
}

void App::save_view() {
    try {
        const std::filesystem::path path = free_name("-view.json");
        write_view(path, session_->view, session_->units());
        say("saved " + path.string() + "; --view starts from it");
    } catch (const Error& error) {
        say(error.what());
    }
}

void App::record() {
    if (clip_) {
        say(fmt::format("stopped: {} pictures in {}", clip_->num_written(),
                        clip_->directory().string()));
        clip_.reset();
        return;
    }
    try {
        const double poses_per_second = double{session_->asset().frames_per_second};
        const ClipLength length = clip_length(
            poses_per_second,
            clip_seconds(session_->view, session_->range().num_poses, poses_per_second));
        clip_.emplace(free_name("-clip"), session_->model_path().stem().string(), length,
                      session_->view, window_.framebuffer_size(), options_.file_samples());
        say(fmt::format("recording {} pictures into {}; F9 stops", clip_->num_frames(),
                        clip_->directory().string()));
    } catch (const Error& error) {
        say(error.what());
    }
}

void App::record_next() {
    try {
        redraws_ = kSettlingFrames;
        if (clip_->write_next(session_->presenter())) return;
        say(fmt::format("saved {} pictures in {}", clip_->num_written(),
                        clip_->directory().string()));
    } catch (const Error& error) {
        say(error.what());
    }
    clip_.reset();
}

std::filesystem::path App::free_name(const std::string& ending) const {
    for (int i = 1;; ++i) {
        const auto name =
            fmt::format("{}-{:03}{}", session_->model_path().stem().string(), i, ending);
        std::error_code ignored;
        if (!std::filesystem::exists(name, ignored)) return name;
    }
}

void run_app(const Options& options, Scene scene) {
    App(options, std::move(scene), nullptr).run();
}

void run_app_from_prefix(Options& options) {
    auto loader = start_loading(options.model_path, options.play_prefix);
    LoadedAsset first = loader->wait_for_first([&] {
        fmt::print(stderr, "paim-play: note: {}: waiting for the first part that can be played\n",
                   options.model_path.string());
    });
    Scene scene = make_scene(options, std::move(first));
    App(options, std::move(scene), std::move(loader)).run();
}

}  // namespace paim::player
