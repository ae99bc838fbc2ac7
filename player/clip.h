// A clip: pictures of the animation over time, into numbered PNG files.
#pragma once

#include <filesystem>
#include <string>

#include "player/options.h"
#include "player/presenter.h"
#include "player/scene.h"

namespace paim::player {

// How long a clip is.
struct ClipLength {
    double frames_per_second = 24.0;
    uint32_t num_frames = 1;
};

// Once through the animation, there and back if it plays so; of a still one, once round whatever turns,
// or one second.
double clip_seconds(const ViewState& view, uint32_t num_poses, double poses_per_second);

// Of the seconds, at least one picture and at most kMaxClipFrames.
ClipLength clip_length(double frames_per_second, double seconds);

constexpr uint32_t kMaxClipFrames = 99999;

// Writes the pictures one at a time, so that a window stays alive meanwhile.
class ClipWriter {
  public:
    // name  of the files: NAME_00001.png and on. Makes the folder. Errors: output failed.
    ClipWriter(std::filesystem::path directory, std::string name, const ClipLength& length,
               const ViewState& start, std::pair<int, int> size, int samples);

    // Draws and writes the next picture. Returns false when all are written.
    bool write_next(Presenter& presenter);

    uint32_t num_written() const { return num_written_; }
    uint32_t num_frames() const { return length_.num_frames; }
    const std::filesystem::path& directory() const { return directory_; }

  private:
    std::filesystem::path directory_;
    std::string name_;
    ClipLength length_;
    ViewState view_;
    std::pair<int, int> size_;
    int samples_;
    uint32_t num_written_ = 0;
};

// --frames-out: the whole clip, without a display, with its progress on stderr.
void write_clip(const Options& options, const Scene& scene);

}  // namespace paim::player
