// --frames-out, and recording from the window.
#include "player/clip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/cli/progress.h"
#include "paim/image/png.h"
#include "player/gl/headless_context.h"
#include "player/report.h"
#include "player/start_view.h"
#include "player/view/view_file.h"

namespace paim::player {

double clip_seconds(const ViewState& view, uint32_t num_poses, double poses_per_second) {
    const double speed = std::abs(view.animation.speed) * poses_per_second;
    if (num_poses > 1 && speed > 0.0) {
        const auto poses = static_cast<double>(num_poses);
        return (view.animation.ping_pong ? 2.0 * (poses - 1.0) : poses) / speed;
    }
    const double light = view.light.turning ? std::abs(view.light.turn_speed_deg) : 0.0;
    const double turn_deg = std::max(light, std::abs(view.camera.turn_speed_deg));
    return turn_deg > 0.0 ? 360.0 / turn_deg : 1.0;
}

ClipLength clip_length(double frames_per_second, double seconds) {
    const double frames = std::clamp(std::round(frames_per_second * seconds), 1.0,
                                     static_cast<double>(kMaxClipFrames));
    return {frames_per_second, static_cast<uint32_t>(frames)};
}

ClipWriter::ClipWriter(std::filesystem::path directory, std::string name, const ClipLength& length,
                       const ViewState& start, std::pair<int, int> size, int samples)
    : directory_(std::move(directory)),
      name_(std::move(name)),
      length_(length),
      view_(start),
      size_(size),
      samples_(samples) {
    view_.animation.playing = true;
    ensure_directory(directory_);
}

bool ClipWriter::write_next(Presenter& presenter) {
    if (num_written_ == length_.num_frames) return false;
    if (num_written_ == 0) presenter.fix_scale(view_);
    const Image image = presenter.render(view_, size_.first, size_.second, samples_);
    write_png(directory_ / fmt::format("{}_{:05}.png", name_, num_written_ + 1), image,
              Presenter::tone_curve(view_));
    const Asset& asset = presenter.asset();
    advance(view_, asset.num_poses(), double{asset.frames_per_second},
            1.0 / length_.frames_per_second);
    ++num_written_;
    return num_written_ < length_.num_frames;
}

void write_clip(const Options& options, const Scene& scene) {
    const auto context = gl::make_headless_context();
    const int samples = options.file_samples();
    const auto [width, height] = options.size;
    Presenter presenter = make_presenter(options, scene);
    const ViewState view = start_view(options, scene, presenter,
                                      static_cast<float>(width) / static_cast<float>(height));
    const double poses_per_second = double{scene.asset->frames_per_second};
    const ClipLength length =
        clip_length(options.clip->frames_per_second.value_or(poses_per_second),
                    options.clip->seconds.value_or(
                        clip_seconds(view, scene.asset->num_poses(), poses_per_second)));
    const double asked = length.frames_per_second * options.clip->seconds.value_or(0.0);
    if (std::round(asked) > kMaxClipFrames) {
        throw_usage("--fps and --seconds: expected at most {} pictures, got {}", kMaxClipFrames,
                    std::round(asked));
    }
    ClipWriter writer(options.clip->directory, options.model_path.stem().string(), length, view,
                      options.size, samples);
    cli::Progress progress("drawing", "pictures", length.num_frames, options.json);
    bool more = true;
    while (more) {
        more = writer.write_next(presenter);
        progress.advance();
    }
    progress.finish();
    if (options.save_view_path) write_view(*options.save_view_path, view, scene.units);
    if (!options.json) return;
    nlohmann::ordered_json json =
        describe_picture(options, scene, presenter, view, context->description(), samples);
    json["directory"] = options.clip->directory.string();
    json["pictures"] = writer.num_written();
    json["frames_per_second"] = length.frames_per_second;
    fmt::print("{}\n", json_text(json, 2));
}

}  // namespace paim::player
