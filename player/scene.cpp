// Loading.
#include "player/scene.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "paim/base/error.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/image/exr.h"
#include "paim/light/environment.h"
#include "paim/light/sky.h"
#include "player/read_asset.h"

namespace paim::player {

namespace {

// all_there  the file will not have more
void lower_limit(const char* option, const char* what, uint32_t& limit, uint32_t available,
                 bool all_there) {
    if (limit == DecodeLimits().bands || (limit > available && !all_there)) {
        limit = available;
    } else if (limit > available) {
        fmt::print(stderr, "paim-play: note: {} {}: the file has {} {}, using all of them\n",
                   option, limit, available, what);
        limit = available;
    }
}

}  // namespace

Scene load_scene(Options& options) {
    if (options.progressive) return make_scene(options, load_beginning(options.model_path));
    LoadedAsset loaded;
    loaded.asset = read_asset(options.model_path);
    loaded.bounds = sequence_bounds(*loaded.asset);
    std::error_code ignored;
    loaded.progress.size_bytes = std::filesystem::file_size(options.model_path, ignored);
    return make_scene(options, std::move(loaded));
}

Scene make_scene(Options& options, LoadedAsset loaded) {
    Scene scene;
    scene.asset = std::move(loaded.asset);
    scene.bounds = loaded.bounds;
    scene.size_bytes = loaded.progress.size_bytes;
    if (options.progressive) scene.progress = loaded.progress;
    const Asset& asset = *scene.asset;
    const CodedMesh& mesh = asset.moving();

    const double last_pose = static_cast<double>(asset.num_poses()) - 1.0;
    if (options.pose > last_pose) {
        throw_usage("--pose: expected 0 to {} ({} has {} poses), got {}", last_pose,
                    options.model_path.string(), asset.num_poses(), options.pose);
    }
    DecodeLimits& limits = options.limits;
    lower_limit("--geometry-components", "geometry components", limits.geometry_components,
                mesh.positions.num_components, asset.complete);
    lower_limit("--transfer-components", "transfer components", limits.transfer_components,
                mesh.transfer->matrix.num_components, asset.complete);
    lower_limit("--cluster-components", "cluster components", limits.cluster_components,
                mesh.transfer->num_vertex_components(), true);
    lower_limit("--bands", "bands", limits.bands, mesh.layout.in_bands, true);

    scene.environment =
        options.environment_path ? load_environment(*options.environment_path) : make_sky();
    return scene;
}

Image load_environment(const std::filesystem::path& path) {
    Image image = read_exr(path);
    try {
        return EnvironmentLight(std::move(image)).image();
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", path.string(), error.what()));
    }
}

}  // namespace paim::player
