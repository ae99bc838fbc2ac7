// Loading.
#include "player/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "paim/base/error.h"
#include "paim/cli/light_options.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/light/load_light.h"
#include "paim/light/sky.h"
#include "player/read_asset.h"

namespace paim::player {

namespace {

// What is wanted, or all that is available, with a note if that is less.
// all_there  the file will not have more
uint32_t limit_of(const char* option, const char* what, std::optional<uint32_t> wanted,
                  uint32_t available, bool all_there) {
    if (wanted && *wanted > available && all_there) {
        fmt::print(stderr, "paim-play: note: {} {}: the file has {} {}, using all of them\n",
                   option, *wanted, available, what);
    }
    return std::min(wanted.value_or(available), available);
}

// What the options name, with notes on how it was read, or the built-in sky.
EnvironmentLight load_environment(const Options& options) {
    if (!options.environment_path) return EnvironmentLight(make_sky());
    const LoadedLight loaded = load_light(*options.environment_path, options.env_mapping);
    cli::print_notes("paim-play", *options.environment_path, loaded.notes);
    return loaded.light;
}

}  // namespace

Scene load_scene(Options& options) {
    if (options.play_prefix) return make_scene(options, load_prefix(options.model_path));
    LoadedAsset loaded;
    loaded.asset = read_asset(options.model_path, {}, &loaded.units);
    loaded.bounds = sequence_bounds(*loaded.asset);
    std::error_code ignored;
    loaded.progress.size_bytes = std::filesystem::file_size(options.model_path, ignored);
    return make_scene(options, std::move(loaded));
}

Scene make_scene(Options& options, LoadedAsset loaded) {
    Scene scene{nullptr, EnvironmentLight(Image(1, 1)), {}, {}, 0, {}};
    scene.units = loaded.units;
    scene.asset = std::move(loaded.asset);
    scene.bounds = loaded.bounds;
    scene.size_bytes = loaded.progress.size_bytes;
    if (options.play_prefix) scene.progress = loaded.progress;
    const Asset& asset = *scene.asset;
    const CodedMesh& mesh = asset.moving();

    ViewState view;
    for (const auto& change : options.view_changes) change(view);
    const double last_pose = static_cast<double>(asset.num_poses()) - 1.0;
    if (view.animation.time > last_pose) {
        throw_usage("--pose: expected 0 to {} ({} has {} poses), got {}", last_pose,
                    options.model_path.string(), asset.num_poses(), view.animation.time);
    }
    const WantedLimits& wanted = options.wanted;
    DecodeLimits& limits = options.limits;
    limits.geometry_components =
        limit_of("--geometry-components", "geometry components", wanted.geometry_components,
                 mesh.positions.num_components, asset.complete);
    limits.transfer_components =
        limit_of("--transfer-components", "transfer components", wanted.transfer_components,
                 mesh.transfer->matrix.num_components, asset.complete);
    const uint32_t vertex_components = mesh.transfer->num_vertex_components();
    limits.vertex_components = vertex_components;
    if (const auto& asked = wanted.vertex_components) {
        const bool own = asked->words->codec == mesh.transfer->codec_name();
        const uint32_t limit = limit_of(asked->words->option, asked->words->components,
                                        asked->count, own ? vertex_components : 0, true);
        if (own) limits.vertex_components = limit;
    }
    limits.bands = limit_of("--bands", "bands", wanted.bands, mesh.light_bands(), true);

    scene.environment = load_environment(options);
    return scene;
}

}  // namespace paim::player
