// The command line of paim-play.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "paim/light/env_mapping.h"
#include "player/render/codec_words.h"
#include "player/render/vertex_source.h"
#include "player/view_options.h"

namespace paim::player {

// How much of the file's detail is asked for; nothing: all that it has.
struct WantedLimits {
    std::optional<uint32_t> geometry_components;
    std::optional<uint32_t> transfer_components;
    std::optional<uint32_t> bands;
    // Of the components of vertices, and whose option asked for them.
    struct VertexComponents {
        const CodecWords* words;
        uint32_t count;
    };
    std::optional<VertexComponents> vertex_components;

    // The same numbers, where nothing was asked for the largest there are.
    DecodeLimits limits() const;
};

// Where the camera stands at first, relative to the one that sees all poses.
struct CameraOptions {
    double azimuth_rad = double{kDefaultAzimuth_rad};
    double elevation_rad = double{kDefaultElevation_rad};
    double distance_factor = 1.0;
};

// What it looks at.
struct TargetOptions {
    CameraTarget target = CameraTarget::all;
    Vec3d point = Vec3d::Zero();  // of CameraTarget::point, scene units
};

// A clip, written picture by picture.
struct ClipOptions {
    std::filesystem::path directory;
    std::optional<double> frames_per_second;  // else the rate of the file
    std::optional<double> seconds;            // else once through the animation
};

struct Options {
    std::filesystem::path model_path;
    std::optional<std::filesystem::path> environment_path;  // else the built-in sky
    EnvMapping env_mapping = EnvMapping::automatic;
    WantedLimits wanted;
    DecodeLimits limits;  // as wanted, but no more than the file has; set when it is loaded
    Decoder decoder = Decoder::automatic;
    std::pair<int, int> size{1280, 720};  // pixels
    std::optional<int> supersample;       // else 2 for files, 1 otherwise

    std::optional<std::filesystem::path> view_path;       // to start from
    std::optional<std::filesystem::path> save_view_path;  // to write
    ViewChanges view_changes;                             // over the view of that file
    bool auto_exposure = false;
    std::optional<CameraOptions> camera;
    std::optional<TargetOptions> target;

    std::optional<std::filesystem::path> snapshot_path;
    std::optional<ClipOptions> clip;
    std::optional<int> bench_frames;
    std::optional<int> window_frames;  // then quit
    bool json = false;
    bool play_prefix = false;  // --progressive: the prefix that is there of an incomplete file

    int window_samples() const { return supersample.value_or(1); }
    int file_samples() const { return supersample.value_or(2); }
    bool opens_window() const { return !snapshot_path && !clip && !bench_frames; }
};

// Fills the options. Returns an exit code where there is nothing more to do (help, version, a
// command line that CLI11 refuses), or -1. Throws Error(usage) that names the option for values out
// of range.
int parse_options(int argc, const char* const* argv, Options& options);

}  // namespace paim::player
