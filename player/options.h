// The command line of paim-play.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "paim/image/tone.h"
#include "paim/light/env_mapping.h"
#include "player/render/codec_words.h"
#include "player/render/frame.h"
#include "player/render/vertex_source.h"
#include "player/ui/orbit_camera.h"

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

struct Options {
    std::filesystem::path model_path;
    std::optional<std::filesystem::path> environment_path;  // else the built-in sky
    EnvMapping env_mapping = EnvMapping::automatic;
    WantedLimits wanted;
    Decoder decoder = Decoder::automatic;
    DecodeLimits limits;  // as wanted, but no more than the file has; set when it is loaded
    ToneCurve tone_curve;
    double pose = 0.0;
    double env_rotation_rad = 0.0;
    std::pair<int, int> size{1280, 720};  // pixels
    std::optional<int> supersample;       // else 2 for snapshots, 1 otherwise
    Background background;
    CameraOptions camera;
    std::optional<std::filesystem::path> snapshot_path;
    std::optional<int> bench_frames;
    std::optional<int> window_frames;  // then quit
    bool json = false;
    bool play_prefix = false;  // --progressive: the prefix that is there of an incomplete file

    bool opens_window() const { return !snapshot_path && !bench_frames; }
};

// Fills the options. Returns an exit code where there is nothing more to do (help, version, a
// command line that CLI11 refuses), or -1. Throws Error(usage) that names the option for values out
// of range.
int parse_options(int argc, const char* const* argv, Options& options);

}  // namespace paim::player
