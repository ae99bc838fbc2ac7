// Poses of a .paim, as the stage and the bake have them.
#include "analysis/file_poses.h"

#include "paim/metrics/asset_error.h"

namespace paim {

namespace {

std::vector<float> in_order_of_bake(const std::vector<float>& planes,
                                    const std::vector<uint32_t>& old_vertex) {
    const size_t num_vertices = old_vertex.size();
    std::vector<float> ordered(planes.size());
    for (size_t begin = 0; begin < planes.size(); begin += num_vertices) {
        for (size_t v = 0; v < num_vertices; ++v)
            ordered[begin + old_vertex[v]] = planes[begin + v];
    }
    return ordered;
}

void put_in_order(const std::vector<uint32_t>& old_vertex, DecodedPose& pose) {
    pose.positions = in_order_of_bake(pose.positions, old_vertex);
    pose.transfer = in_order_of_bake(pose.transfer, old_vertex);
    const std::vector<Eigen::Matrix3f> frames = pose.frames;
    for (size_t v = 0; v < frames.size(); ++v) pose.frames[old_vertex[v]] = frames[v];
}

}  // namespace

FilePoses::FilePoses(const Asset& asset, const BakeReader& bake)
    : decoder_(asset.moving()),
      old_vertex_(match_part(asset, 0, bake)),
      num_following_(bake.identity().num_following) {
    if (asset.still() == nullptr) return;
    MeshDecoder decoder(*asset.still());
    still_.emplace();
    decoder.decode(0.0, {}, *still_);
    put_in_order(match_part(asset, 1, bake), *still_);
}

DecodedPose FilePoses::pose(double time, const DecodeLimits& limits) {
    decoder_.decode(time, limits, decoded_);
    DecodedPose pose = decoded_;
    put_in_order(old_vertex_, pose);
    pose.num_following = num_following_;
    return pose;
}

}  // namespace paim
