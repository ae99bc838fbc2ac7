// What the command line of paim-compress sets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compressor/bake/bake_options.h"
#include "compressor/encode/options.h"
#include "compressor/io/obj_gloss.h"
#include "compressor/io/vertex_colours.h"
#include "compressor/scene/floor.h"
#include "compressor/scene/root_motion.h"

namespace paim {

struct CompressOptions {
    enum class Command { bake_and_encode, bake, encode } command = Command::bake_and_encode;

    // Bake.
    std::vector<std::string> inputs;  // OBJ files, patterns, directories
    bool keep_order = false;
    BakeOptions bake;
    // The bake has as many rays as the target needs, instead of bake.rays.
    bool chooses_rays = false;
    std::string normals = "faces";  // or "file"
    bool orient = false;
    std::optional<Vec3f> albedo;
    ColourCurve vertex_colours = ColourCurve::automatic;
    GlossChoice gloss;
    bool textures = true;  // of the OBJ files
    std::optional<FloorOptions> floor;
    std::vector<std::string> statics;  // OBJ files of still meshes
    RootMotionChoice root_motion = RootMotionChoice::automatic;
    std::string poses;  // "A-B", empty for all
    bool discard_bake = false;

    // Encode.
    std::filesystem::path bake_directory;  // of `encode`
    EncodeOptions encode;
    std::optional<EncodeTarget> target;              // without its band power
    std::optional<double> gloss_error;               // if another than that of the transfer
    std::string band_power = "flat";                 // or "natural" or a file
    EnvMapping env_mapping = EnvMapping::automatic;  // of the file

    std::filesystem::path output;
    int num_threads = 0;
    bool json = false;
    bool quiet = false;
};

// The last group of options in the help.
constexpr const char* kRunningGroup = "Running";

}  // namespace paim
