// The window's loop.
#include "player/app.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "paim/base/error.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/image/png.h"
#include "paim/light/load_light.h"
#include "player/gl/check.h"
#include "player/gl/window.h"
#include "player/prefix_loader.h"
#include "player/render/pose_bounds_cache.h"
#include "player/render/scene_renderer.h"
#include "player/render/tone_mapper.h"
#include "player/report.h"
#include "player/ui/imgui_layer.h"
#include "player/ui/keys.h"
#include "player/ui/orbit_camera.h"
#include "player/ui/overlay.h"

namespace paim::player {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kMessageSeconds = 6.0;
constexpr double kIdleWaitSeconds = 0.1;  // between frames while nothing moves
constexpr int kSnapshotSamples = 2;

// Uploads all of the model, so that limits can be raised again, or, where that is more than this
// driver takes, what the options ask for.
template <typename Upload>
auto upload_within(const DecodeLimits& wanted, Upload upload) {
    try {
        return upload(DecodeLimits());
    } catch (const Error&) {
        return upload(wanted);
    }
}

class App {
  public:
    // loader  of the rest of the file, or nullptr
    App(const Options& options, Scene scene, PrefixLoader* loader)
        : options_(options),
          scene_(std::make_unique<Scene>(std::move(scene))),
          loader_(loader),
          window_(options.size.first, options.size.second,
                  options.model_path.filename().string() + " - paim-play"),
          renderer_(upload_within(options.wanted.limits(),
                                  [&](const DecodeLimits& limits) {
                                      return std::make_unique<SceneRenderer>(scene_->asset, limits,
                                                                             options.decoder);
                                  })),
          range_(range()),
          environment_name_(options.environment_path ? options.environment_path->filename().string()
                                                     : "built-in sky") {
        renderer_->set_environment(scene_->environment.image());
        bounds_.emplace(*scene_->asset);
        view_.time = options.pose;
        view_.limits = options.limits;
        view_.tone_curve = options.tone_curve;
        view_.env_rotation_deg = std::remainder(options.env_rotation_rad * 180.0 / kPi, 360.0);
        view_.background = options.background;
        frame_all();
        listen();
        imgui_.emplace(window_);
    }

    void run() {
        auto last = Clock::now();
        for (int i = 0; !window_.should_close() && i != options_.window_frames.value_or(-1); ++i) {
            const bool moving = view_.playing || view_.turning || options_.window_frames;
            window_.poll(moving && is_visible() ? 0.0 : kIdleWaitSeconds);
            const auto now = Clock::now();
            const double elapsed_s = std::chrono::duration<double>(now - last).count();
            last = now;
            if (loader_ != nullptr) show_more();
            advance(view_, range_, scene_->asset->frames_per_second, elapsed_s);
            draw();
            if (loader_ != nullptr) loader_->read_on();
        }
    }

  private:
    ViewRange range() const {
        const DecodeLimits most = renderer_->most();
        return {scene_->asset->num_poses(), most.geometry_components, most.transfer_components,
                most.bands, most.vertex_components};
    }

    // Takes what has been read since the last frame; all else of the view stays. Throws the error of
    // a file that should be whole and is not.
    void show_more() {
        loader_->check();
        if (const std::string error = loader_->take_error(); !error.empty()) say(error);
        std::optional<LoadedAsset> loaded = loader_->take();
        if (!loaded) return;
        auto scene =
            std::make_unique<Scene>(Scene{nullptr, scene_->environment, scene_->light, {}, 0, {}});
        scene->asset = std::move(loaded->asset);
        scene->bounds = loaded->bounds;
        scene->size_bytes = loaded->progress.size_bytes;
        scene->progress = loaded->progress;
        try {
            upload_within(options_.wanted.limits(), [&](const DecodeLimits& limits) {
                renderer_->set_asset(scene->asset, limits);
            });
        } catch (const Error& error) {
            say(error.what());
            return;
        }
        bounds_.emplace(*scene->asset);
        scene_ = std::move(scene);
        const ViewRange before = std::exchange(range_, range());
        follow(view_, before, range_, options_.wanted.limits());
        // Coarse poses have other bounds. A camera that somebody has moved stays.
        const bool sharpens = !options_.play_prefix && !camera_moved_;
        if (loaded->replaced || sharpens) frame_all();
    }

    void listen() {
        gl::WindowEvents& events = window_.events();
        events.on_key = [this](int key, bool shift) {
            if (!imgui_->wants_text()) carry_out(command_of_key(key, shift));
        };
        events.on_drag = [this](gl::MouseButton button, double dx, double dy) {
            if (imgui_->wants_mouse()) return;
            camera_moved_ = true;
            const auto x = static_cast<float>(dx / window_.height());
            const auto y = static_cast<float>(dy / window_.height());
            if (button == gl::MouseButton::left) {
                camera_.orbit(x, y);
            } else {
                camera_.pan(x, y);
            }
        };
        events.on_scroll = [this](double steps) {
            if (imgui_->wants_mouse()) return;
            camera_moved_ = true;
            camera_.zoom(static_cast<float>(steps));
        };
        events.on_drop = [this](const auto& paths) {
            if (!paths.empty()) change_light(paths.front());
        };
    }

    void carry_out(Command command) {
        if (command == Command::quit) {
            window_.close();
        } else if (command == Command::frame_all) {
            frame_all();
        } else if (command == Command::snapshot) {
            save_view();
        } else {
            apply(command, view_, range_);
        }
    }

    void frame_all() {
        const auto [width, height] = window_.framebuffer_size();
        const float aspect =
            static_cast<float>(std::max(1, width)) / static_cast<float>(std::max(1, height));
        camera_.frame(options_.camera, scene_->bounds, aspect);
    }

    // False while the window is minimised.
    bool is_visible() const {
        const auto [width, height] = window_.framebuffer_size();
        return width > 0 && height > 0;
    }

    Frame current_frame() {
        Frame frame;
        frame.time = view_.time;
        frame.limits = view_.limits;
        set_light(frame, *scene_, view_.env_rotation_deg * kPi / 180.0);
        frame.camera = camera_.camera();
        frame.bounds = bounds_->at(view_.time, view_.limits.geometry_components);
        frame.background = view_.background;
        return frame;
    }

    void draw() {
        if (!is_visible()) return;
        const auto [width, height] = window_.framebuffer_size();
        const auto start = Clock::now();
        const int samples = samples_that_fit(width, height, options_.supersample.value_or(1),
                                             gl::max_target_size());
        if (!target_ || target_->width() != width * samples ||
            target_->height() != height * samples) {
            target_.emplace(width * samples, height * samples);
        }
        renderer_->draw(current_frame(), *target_);
        window_.bind();
        tone_mapper_.draw(*target_, samples, view_.tone_curve);
        imgui_->begin_frame();
        draw_overlay(overlay_info(), range_, view_);
        imgui_->end_frame();
        gl::check_errors("drawing");
        window_.swap();
        const double frame_ms =
            std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        frame_ms_ += (frame_ms_ == 0.0 ? 1.0 : 0.1) * (frame_ms - frame_ms_);
    }

    OverlayInfo overlay_info() const {
        OverlayInfo info;
        info.title = options_.model_path.filename().string();
        info.environment = environment_name_;
        info.renderer = renderer_name_;
        if (Clock::now() < message_end_) info.message = message_;
        info.file_bytes = scene_->size_bytes;
        if (loader_ != nullptr && !scene_->asset->complete) {
            info.loading = progress_text(loader_->progress());
        }
        info.num_vertices = scene_->asset->moving().topology.num_vertices;
        info.num_triangles =
            static_cast<uint32_t>(scene_->asset->moving().topology.triangles.size());
        info.frame_ms = frame_ms_;
        info.cost = frame_cost(scene_->asset->moving(), view_.limits);
        const auto* words = words_of_codec(scene_->asset->moving().transfer->codec_name());
        if (words != nullptr) info.vertex_components = words->components;
        return info;
    }

    void say(const std::string& message) {
        message_ = message;
        message_end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>(kMessageSeconds));
    }

    void change_light(const std::filesystem::path& path) {
        try {
            const LoadedLight light = load_light(path, options_.env_mapping);
            renderer_->set_environment(light.light.image());
            scene_->environment = light.light;
            scene_->light =
                light.light.coefficients(static_cast<int>(scene_->asset->moving().layout.in_bands));
            environment_name_ = path.filename().string();
            std::string message = "light: " + environment_name_;
            for (const std::string& note : light.notes) message += "\n" + note;
            say(message);
        } catch (const Error& error) {
            say(error.what());
        }
    }

    void save_view() {
        try {
            if (!is_visible()) return;
            const auto [width, height] = window_.framebuffer_size();
            const int samples = options_.supersample.value_or(kSnapshotSamples);
            const Image image = renderer_->render(current_frame(), width, height, samples);
            const std::filesystem::path path = free_name();
            write_png(path, image, view_.tone_curve);
            say("saved " + path.string());
        } catch (const Error& error) {
            say(error.what());
        }
    }

    // NAME-001.png in the current directory, or the first number that is not taken.
    std::filesystem::path free_name() const {
        for (int i = 1;; ++i) {
            const auto name = fmt::format("{}-{:03}.png", options_.model_path.stem().string(), i);
            std::error_code ignored;
            if (!std::filesystem::exists(name, ignored)) return name;
        }
    }

    const Options& options_;
    std::unique_ptr<Scene> scene_;
    PrefixLoader* loader_;
    gl::Window window_;
    std::string renderer_name_ = window_.renderer();
    std::unique_ptr<SceneRenderer> renderer_;
    ViewRange range_;
    ToneMapper tone_mapper_;
    std::optional<PoseBoundsCache> bounds_;
    std::optional<gl::Target> target_;
    std::optional<ImGuiLayer> imgui_;
    OrbitCamera camera_;
    bool camera_moved_ = false;  // by hand
    ViewState view_;
    std::string environment_name_;
    std::string message_;
    Clock::time_point message_end_{};
    double frame_ms_ = 0.0;
};

}  // namespace

void run_app(const Options& options, Scene scene) {
    App(options, std::move(scene), nullptr).run();
}

void run_app_from_prefix(Options& options) {
    LoaderPace pace;
    pace.whole = !options.play_prefix;
    // A file that is cut short is refused at once.
    if (pace.whole) const ContainerReader checked(options.model_path, section::kKindAnimation);
    PrefixLoader loader(options.model_path, pace);
    LoadedAsset first = loader.wait_for_first([&] {
        fmt::print(stderr, "paim-play: note: {}: waiting for the first part that can be played\n",
                   options.model_path.string());
    });
    Scene scene = make_scene(options, std::move(first));
    App(options, std::move(scene), &loader).run();
}

}  // namespace paim::player
