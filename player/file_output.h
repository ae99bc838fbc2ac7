// Pictures, views and clips of a window, in files of the current folder with names that are free.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "player/clip.h"
#include "player/session.h"

namespace paim::player {

// All return what to say. Errors: output failed.

// NAME-001.png or NAME-001.exr.
// size  in pixels
std::string save_picture(Session& session, std::pair<int, int> size, int samples,
                         const char* extension);

// NAME-001-view.json.
std::string save_view(const Session& session);

// Records one round of the animation into the folder NAME-001-clip, a picture a call.
class Recorder {
  public:
    bool is_recording() const { return clip_.has_value(); }
    // Share of the pictures that are written.
    std::optional<float> progress() const;

    // Returns what to say.
    std::string start(Session& session, std::pair<int, int> size, int samples);
    // Ends it; the pictures so far stay. Returns what to say.
    std::string stop();
    // Returns what to say when the last picture has been written, before that nothing.
    std::string write_next(Session& session);

  private:
    std::optional<ClipWriter> clip_;
};

}  // namespace paim::player
