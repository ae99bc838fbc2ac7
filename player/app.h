// The window: plays, listens to keys, mouse and panels, and shows what it costs.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "player/file_output.h"
#include "player/gl/target.h"
#include "player/gl/window.h"
#include "player/options.h"
#include "player/render/tone_mapper.h"
#include "player/scene.h"
#include "player/session.h"
#include "player/ui/imgui_layer.h"
#include "player/ui/inspector.h"
#include "player/ui/panels.h"

namespace paim::player {

class App {
  public:
    // loader  of the rest of the file, or nullptr
    // Errors (unsupported): there is no display, which says to use --snapshot.
    App(const Options& options, Scene scene, std::unique_ptr<PrefixLoader> loader);

    // Until the window is closed, or for options.window_frames steps; then saves the view where
    // options.save_view_path says. Throws the error of a file that should be whole and is not.
    void run();

    // Handles what has happened and draws the window if anything has changed. Waits for something to
    // happen, a tenth of a second at most, if nothing moves. Returns whether it drew.
    bool step();

    Session& session() { return *session_; }
    PanelState& panels() { return panels_; }
    gl::Window& window() { return window_; }
    // What the window says now, or empty.
    std::string message() const;

  private:
    using Clock = std::chrono::steady_clock;

    void listen();
    void carry_out(WindowCommand command);
    void open(const std::filesystem::path& path);
    void say(const std::string& message);
    bool is_moving() const;
    bool is_visible() const;
    float aspect() const;

    void draw();
    void draw_picture(int width, int height);
    PanelInfo panel_info();
    void record_next();
    void toggle_recording();
    void close_or_quit();

    const Options& options_;
    gl::Window window_;
    std::string renderer_name_ = window_.renderer();
    std::unique_ptr<Session> session_;
    ToneMapper tone_mapper_;
    std::optional<gl::Target> target_;
    std::optional<ImGuiLayer> imgui_;
    Inspector inspector_;
    PanelState panels_;
    Recorder recorder_;

    std::optional<ViewState> drawn_;  // the view that is on the screen
    int redraws_ = 0;                 // frames to draw in any case: panels take a few to settle
    Clock::time_point last_step_ = Clock::now();
    std::string loading_;  // that is on the screen
    std::string message_;
    Clock::time_point message_end_{};
    double frame_ms_ = 0.0;
};

// Opens the window and returns when it is closed.
void run_app(const Options& options, Scene scene);

// Plays a file that is large, or with options.play_prefix one that is still being written. Waits, with
// a note on stderr, for a prefix of it that can be played; shows more detail when a longer one has been
// read. Errors as load_scene()'s and PrefixLoader's; a damaged file that should be whole closes the
// window.
void run_app_from_prefix(Options& options);

}  // namespace paim::player
