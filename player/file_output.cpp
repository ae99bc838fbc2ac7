// Saving from the window.
#include "player/file_output.h"

#include <fmt/format.h>

#include <system_error>

#include "paim/image/exr.h"
#include "paim/image/png.h"
#include "player/view/view_file.h"

namespace paim::player {

namespace {

// NAME-001ENDING in the current folder, or the first number that is not taken.
std::filesystem::path free_name(const Session& session, const std::string& ending) {
    for (int i = 1;; ++i) {
        const auto name =
            fmt::format("{}-{:03}{}", session.model_path().stem().string(), i, ending);
        std::error_code ignored;
        if (!std::filesystem::exists(name, ignored)) return name;
    }
}

}  // namespace

std::string save_picture(Session& session, std::pair<int, int> size, int samples,
                         const char* extension) {
    const Image image = session.presenter().render(session.view, size.first, size.second, samples);
    const std::filesystem::path path = free_name(session, extension);
    if (path.extension() == ".exr") {
        write_exr(path, image);
    } else {
        write_png(path, image, Presenter::tone_curve(session.view));
    }
    return "saved " + path.string();
}

std::string save_view(const Session& session) {
    const std::filesystem::path path = free_name(session, "-view.json");
    write_view(path, session.view, session.units());
    return "saved " + path.string() + "; --view starts from it";
}

std::optional<float> Recorder::progress() const {
    if (!clip_) return std::nullopt;
    return static_cast<float>(clip_->num_written()) / static_cast<float>(clip_->num_frames());
}

std::string Recorder::start(Session& session, std::pair<int, int> size, int samples) {
    const double poses_per_second = double{session.asset().frames_per_second};
    const ClipLength length = clip_length(
        poses_per_second, clip_seconds(session.view, session.range().num_poses, poses_per_second));
    clip_.emplace(free_name(session, "-clip"), session.model_path().stem().string(), length,
                  session.view, size, samples);
    return fmt::format("recording {} pictures into {}; F9 stops", clip_->num_frames(),
                       clip_->directory().string());
}

std::string Recorder::stop() {
    const std::string words = fmt::format("stopped: {} pictures in {}", clip_->num_written(),
                                          clip_->directory().string());
    clip_.reset();
    return words;
}

std::string Recorder::write_next(Session& session) {
    if (clip_->write_next(session.presenter())) return {};
    const std::string words =
        fmt::format("saved {} pictures in {}", clip_->num_written(), clip_->directory().string());
    clip_.reset();
    return words;
}

}  // namespace paim::player
