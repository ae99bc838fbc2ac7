// What is seen of a file's errors, on the stage of the error curves.
#include "analysis/trade/seen_error.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "paim/base/median.h"
#include "paim/mesh/cache_order.h"
#include "paim/metrics/image_error.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

namespace {

// The largest that is a number.
double largest_seen(const std::vector<ImageError>& errors) {
    double largest = std::numeric_limits<double>::quiet_NaN();
    for (const ImageError& error : errors) largest = std::fmax(largest, error.visual_error());
    return largest;
}

// What files are compared with.
struct SeenReferences {
    std::vector<std::vector<Image>> images;  // [poses][lights]
    std::vector<uint32_t> new_vertex;        // [V] where each vertex of the bake is in files
    uint32_t num_following = 0;              // vertices of the bake
};

// With the vertices as the bake has them.
DecodedPose in_order_of_bake(DecodedPose pose, const SeenReferences& references) {
    reorder_planes(pose.positions, references.new_vertex);
    reorder_planes(pose.transfer, references.new_vertex);
    pose.num_following = references.num_following;
    return pose;
}

PlayedFile play(const Asset& asset, const Stage& stage, const SeenReferences& references) {
    using Clock = std::chrono::steady_clock;
    MeshDecoder decoder(asset.moving());
    std::vector<ImageError> errors(stage.lights().size());
    std::vector<double> times_ms;
    DecodedPose decoded;
    for (size_t j = 0; j < references.images.size(); ++j) {
        const uint32_t p = stage.poses()[j];
        // Allocates memory, so that the timed call does not.
        decoder.decode(p, {}, decoded);
        const auto start = Clock::now();
        decoder.decode(p, {}, decoded);
        times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        const std::vector<Image> images = stage.render_pose(in_order_of_bake(decoded, references));
        for (size_t light = 0; light < images.size(); ++light) {
            errors[light].add(compare_images(images[light], references.images[j][light]));
        }
    }
    return {largest_seen(errors), median(std::move(times_ms))};
}

}  // namespace

PlayFile play_on_stage(const BakeReader& bake, const Stage& stage) {
    auto references = std::make_shared<SeenReferences>();
    const std::vector<uint32_t> old_vertex = cache_order(bake.topology()).old_vertex;
    references->new_vertex.resize(old_vertex.size());
    for (uint32_t n = 0; n < old_vertex.size(); ++n) references->new_vertex[old_vertex[n]] = n;
    references->num_following = bake.identity().num_following;
    for (const uint32_t p : stage.poses()) {
        BakedPose file = bake.read_pose(p);
        references->images.push_back(stage.render_pose(
            {bake.identity().layout, std::move(file.positions), std::move(file.transfer),
             root_at(bake.identity().root_motion, p), bake.identity().num_following}));
    }
    return [&stage, references = std::move(references)](const Asset& asset) {
        return play(asset, stage, *references);
    };
}

}  // namespace paim
