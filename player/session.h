// What the window shows: the model, its light and the view, and how each is replaced by another file.
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "player/inspect/accuracy.h"
#include "player/options.h"
#include "player/prefix_loader.h"
#include "player/presenter.h"
#include "player/scene.h"

namespace paim::player {

class Session {
  public:
    // loader  of the rest of the file, or nullptr
    // aspect  width / height of the window
    // Errors: those of make_presenter() and start_view().
    Session(const Options& options, Scene scene, std::unique_ptr<PrefixLoader> loader,
            float aspect);

    ViewState view;

    Presenter& presenter() { return *presenter_; }
    const Asset& asset() const { return presenter_->asset(); }
    ViewRange range() const { return presenter_->range(); }
    const SceneUnits& units() const { return units_; }

    const std::filesystem::path& model_path() const { return model_path_; }
    const std::string& environment_name() const { return environment_name_; }
    uint64_t file_bytes() const { return file_bytes_; }
    // How much of the file is there, in words; empty once all is.
    std::string loading() const;

    // Opens a model (.paim) or a light (all others). Returns what to say about it. On an error the old one
    // stays, and the error names the file.
    std::string open(const std::filesystem::path& path, float aspect);

    // Takes what the loader has read since the last call. Returns whether that is anything; sets `message`
    // if something is to be said. Throws the error of the command line's file if that should be whole and is not.
    bool take_more(float aspect, std::string& message);
    // Lets the loader read on, once what it read last is on the screen.
    void read_on();

    // Shows all poses, or the one that is shown.
    void frame(float aspect, bool pose_alone);
    // The camera goes with the body from now on, or stays where it is; what it sees now does not jump.
    void follow_body(bool follows);
    // A camera that somebody has moved stays when more of the file arrives.
    void camera_moved() { camera_moved_ = true; }

    // Errors stated, and those of limits. It is made on a thread of its own, once the whole file is there;
    // nullptr until then.
    const AccuracyMeter* accuracy_meter();
    bool is_measuring() const { return measuring_.valid(); }

  private:
    std::string open_model(const std::filesystem::path& path, float aspect);
    std::string open_light(const std::filesystem::path& path);
    void show(LoadedAsset loaded);
    void start_anew(float aspect);

    const Options& options_;
    std::filesystem::path model_path_;
    std::string environment_name_;
    SceneUnits units_;
    uint64_t file_bytes_ = 0;
    std::unique_ptr<PrefixLoader> loader_;
    std::unique_ptr<Presenter> presenter_;
    std::unique_ptr<AccuracyMeter> accuracy_;
    std::future<std::unique_ptr<AccuracyMeter>> measuring_;
    std::shared_ptr<const Asset> measured_;  // of which that is
    bool is_first_model_ = true;             // that of the command line
    bool camera_moved_ = false;
};

// Whether a window shows the first part of a file before all of it is read.
bool is_large(const std::filesystem::path& path);

// Begins to read a file that is large or, with play_prefix, still being written.
// Errors: bad input at once for a file that is cut short, unless play_prefix.
std::unique_ptr<PrefixLoader> start_loading(const std::filesystem::path& path, bool play_prefix);

}  // namespace paim::player
