// What a command line names, loaded and checked: the animation and its light.
#pragma once

#include <memory>
#include <optional>

#include "paim/codec/asset.h"
#include "paim/light/environment.h"
#include "paim/mesh/bounds.h"
#include "player/file_prefix.h"
#include "player/options.h"

namespace paim::player {

struct Scene {
    std::shared_ptr<const Asset> asset;
    EnvironmentLight environment;
    SceneUnits units;
    Bounds bounds;                         // of the whole animation
    uint64_t size_bytes = 0;               // of the .paim file, or of the prefix that is there
    std::optional<LoadProgress> progress;  // of the prefix, where the options ask for one
};

// Reads the animation and the environment. Lowers the options' limits to what the file has, with a
// note on stderr. Errors name the file; Error(usage) if the pose is beyond the last.
Scene load_scene(Options& options);

// The same of an animation that has been read: all of it, or a prefix.
Scene make_scene(Options& options, LoadedAsset loaded);

}  // namespace paim::player
