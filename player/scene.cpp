// Loading.
#include "player/scene.h"

#include <fmt/format.h>

#include <cstdio>

#include "paim/base/error.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/format/paim_file.h"
#include "paim/image/exr.h"
#include "paim/light/environment.h"
#include "paim/light/sky.h"

namespace paim::player {

namespace {

void lower_limit(const char* option, const char* what, uint32_t& limit, uint32_t available) {
    if (limit == DecodeLimits().bands) {
        limit = available;
    } else if (limit > available) {
        fmt::print(stderr, "paim-play: note: {} {}: the file has {} {}, using all of them\n",
                   option, limit, available, what);
        limit = available;
    }
}

}  // namespace

Scene load_scene(Options& options) {
    Scene scene;
    scene.model = read_paim(options.model_path);
    const Model& model = scene.model;
    std::error_code ignored;
    scene.size_bytes = std::filesystem::file_size(options.model_path, ignored);

    const double last_pose = static_cast<double>(model.num_poses()) - 1.0;
    if (options.pose > last_pose) {
        throw_usage("--pose: expected 0 to {} ({} has {} poses), got {}", last_pose,
                    options.model_path.string(), model.num_poses(), options.pose);
    }
    lower_limit("--geometry-components", "geometry components", options.limits.geometry_components,
                model.geometry.num_components);
    lower_limit("--transfer-components", "transfer components", options.limits.transfer_components,
                model.transfer.num_components);
    lower_limit("--cluster-components", "cluster components", options.limits.cluster_components,
                model.clusters.num_components);
    lower_limit("--bands", "bands", options.limits.bands, model.layout.bands);

    scene.environment =
        options.environment_path ? load_environment(*options.environment_path) : make_sky();
    scene.bounds = sequence_bounds(model);
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
