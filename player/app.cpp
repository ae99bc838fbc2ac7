// The window's loop.
#include "player/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paim/base/error.h"
#include "player/gl/check.h"
#include "player/ui/recent_files.h"
#include "player/view/view_file.h"

namespace paim::player {

namespace {

constexpr double kMessageSeconds = 6.0;
constexpr double kIdleWaitSeconds = 0.1;  // at most, between looks at what has happened
constexpr int kSettlingFrames = 3;

std::string title_of(const std::filesystem::path& model) {
    return model.filename().string() + " - paim-play";
}

}  // namespace

App::App(const Options& options, Scene scene, std::unique_ptr<PrefixLoader> loader)
    : options_(options),
      window_(options.size.first, options.size.second, title_of(options.model_path)) {
    session_ = std::make_unique<Session>(options, std::move(scene), std::move(loader), aspect());
    listen();
    imgui_.emplace(window_);
    panels_.recent = read_recent_files();
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
    if (recorder_.is_recording()) {
        record_next();
    } else {
        advance(session_->view, session_->range().num_poses,
                double{session_->asset().frames_per_second}, elapsed_s);
    }
    const bool measured = inspector_.advance(*session_) || session_->is_measuring();
    const bool message_ends = !message_.empty() && now >= message_end_;
    if (message_ends) message_.clear();
    const bool draws =
        is_visible() && (redraws_ > 0 || message_ends || measured || options_.window_frames ||
                         drawn_ != session_->view || session_->loading() != loading_);
    if (draws) draw();
    session_->read_on();
    return draws;
}

bool App::is_moving() const {
    const ViewState& view = session_->view;
    const bool plays =
        view.animation.playing && view.animation.speed != 0.0 && session_->range().num_poses > 1;
    const bool turns = (view.light.turning && view.light.turn_speed_deg != 0.0) ||
                       view.camera.turn_speed_deg != 0.0;
    return plays || turns || recorder_.is_recording() || inspector_.is_measuring();
}

void App::listen() {
    gl::WindowEvents& events = window_.events();
    events.on_any = [this] { redraws_ = kSettlingFrames; };
    events.on_key = [this](int key, bool shift, bool repeated) {
        if (imgui_->wants_text()) return;
        const KeyBinding* const binding = find_key(key, shift);
        if (binding == nullptr || (repeated && !binding->repeats)) return;
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
        if (imgui_->wants_mouse()) return;
        session_->view.picked = session_->presenter().pick(session_->view, static_cast<float>(x),
                                                           static_cast<float>(y), aspect());
    };
    events.on_drop = [this](const auto& paths) {
        for (const auto& path : paths) open(path);
    };
}

void App::carry_out(WindowCommand command) {
    Session& session = *session_;
    const std::pair<int, int> size = window_.framebuffer_size();
    try {
        switch (command) {
            case WindowCommand::none:
                break;
            case WindowCommand::frame_all:
                session.frame(aspect(), false);
                break;
            case WindowCommand::frame_pose:
                session.camera_moved();
                session.frame(aspect(), true);
                break;
            case WindowCommand::follow_body:
                session.follow_body(session.view.camera.target != CameraTarget::pose);
                break;
            case WindowCommand::auto_exposure:
                session.view.tone_curve.exposure_ev =
                    session.presenter().suitable_exposure_ev(session.view);
                break;
            case WindowCommand::snapshot_png:
                if (is_visible()) say(save_picture(session, size, options_.file_samples(), ".png"));
                break;
            case WindowCommand::snapshot_exr:
                if (is_visible()) say(save_picture(session, size, options_.file_samples(), ".exr"));
                break;
            case WindowCommand::save_view:
                say(save_view(session));
                break;
            case WindowCommand::open_file:
                panels_.show_open = !panels_.show_open;
                panels_.folder.clear();
                break;
            case WindowCommand::record:
                toggle_recording();
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
                close_or_quit();
                break;
        }
    } catch (const Error& error) {
        say(error.what());
    }
}

// What lies over the picture first.
void App::close_or_quit() {
    if (panels_.show_help || panels_.show_open) {
        panels_.show_help = panels_.show_open = false;
    } else {
        window_.close();
    }
}

void App::open(const std::filesystem::path& path) {
    try {
        const std::shared_ptr<const Asset> before = session_->presenter().shared_asset();
        say(session_->open(path, aspect()));
        if (recorder_.is_recording() && session_->presenter().shared_asset() != before) {
            say(message_ + "\n" + recorder_.stop());
        }
        window_.set_title(title_of(session_->model_path()));
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
    loading_ = info.loading;
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
    // With one sample a pixel, radiance need not be kept.
    const gl::TargetKind kind = samples == 1 ? gl::TargetKind::display : gl::TargetKind::radiance;
    if (!target_ || target_->kind() != kind || target_->width() != width * samples ||
        target_->height() != height * samples) {
        target_.emplace(width * samples, height * samples, kind);
    }
    session_->presenter().draw(session_->view, *target_);
    window_.bind();
    if (kind == gl::TargetKind::display) {
        target_->show();
    } else {
        tone_mapper_.draw(*target_, samples, Presenter::tone_curve(session_->view));
    }
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
    if (!renderer.decoder_note().empty()) info.decoder += ": " + renderer.decoder_note();
    info.message = message_;
    info.loading = session_->loading();
    info.file_bytes = session_->file_bytes();
    info.texture_bytes = renderer.texture_bytes();
    info.buffer_bytes = renderer.buffer_bytes();
    info.num_vertices = mesh.topology.num_vertices;
    info.num_triangles = static_cast<uint32_t>(mesh.topology.triangles.size());
    info.has_gloss = std::ranges::any_of(
        session_->asset().parts, [](const CodedMesh& part) { return part.gloss.has_value(); });
    info.has_textures = std::ranges::any_of(
        session_->asset().parts, [](const CodedMesh& part) { return !part.texture.empty(); });
    info.frame_ms = frame_ms_;
    info.poses_per_second = session_->asset().frames_per_second;
    const auto* words = words_of_codec(mesh.transfer->codec_name());
    if (words != nullptr) info.vertex_components = words->components;
    info.recorded = recorder_.progress();
    if (!panels_.show_panels) return info;
    info.cost = frame_cost(mesh, session_->view.limits);
    if (const AccuracyMeter* const meter = session_->accuracy_meter()) {
        info.accuracy = meter->at(session_->view.limits);
        info.accuracy_note = meter->note();
    }
    inspector_.describe(*session_, panels_, aspect(), info);
    return info;
}

void App::toggle_recording() {
    if (recorder_.is_recording()) {
        say(recorder_.stop());
    } else if (is_visible()) {
        say(recorder_.start(*session_, window_.framebuffer_size(), options_.file_samples()));
    }
}

void App::record_next() {
    redraws_ = kSettlingFrames;
    try {
        const std::string words = recorder_.write_next(*session_);
        if (!words.empty()) say(words);
    } catch (const Error& error) {
        const std::string stopped = recorder_.stop();
        say(std::string(error.what()) + "\n" + stopped);
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
