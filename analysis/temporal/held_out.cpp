// Poses that a file was made without.
#include "analysis/temporal/held_out.h"

#include <set>
#include <utility>

#include "analysis/file_poses.h"
#include "analysis/scratch_directory.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/base/check.h"
#include "paim/format/paim/paim_read.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

// Writes poses 0, 2, 4 … as a bake of its own.
void write_every_other(const BakeReader& bake, const std::filesystem::path& directory) {
    BakeIdentity identity = bake.identity();
    identity.poses.clear();
    identity.root_motion.clear();
    for (uint32_t p = 0; p < bake.num_poses(); p += 2) {
        identity.poses.push_back(bake.identity().poses[p]);
        if (!bake.identity().root_motion.empty()) {
            identity.root_motion.push_back(bake.identity().root_motion[p]);
        }
    }
    const BakeWriter writer(directory, identity, bake.topology(), bake.albedo(), bake.texture(),
                            bake.materials());
    if (bake.still_mesh()) writer.write_still_mesh(*bake.still_mesh());
    for (uint32_t p = 0; p < bake.num_poses(); p += 2) {
        writer.write_pose(p / 2, bake.read_pose(p));
    }
}

// The pose halfway between two others of the bake.
DecodedPose halfway(const DecodedPose& a, const DecodedPose& b) {
    DecodedPose middle = a;
    const auto blend = [](std::vector<float>& to, const std::vector<float>& other) {
        for (size_t j = 0; j < to.size(); ++j) to[j] = 0.5f * (to[j] + other[j]);
    };
    blend(middle.positions, b.positions);
    blend(middle.transfer, b.transfer);
    middle.root = root_at({a.root, b.root}, 0.5);
    return middle;
}

}  // namespace

HeldOut measure_held_out(const BakeReader& bake, const Stage& stage, double target,
                         const std::filesystem::path& directory,
                         const std::function<void()>& on_pose) {
    PAIM_CHECK_LE(3u, bake.num_poses());
    const ScratchDirectory scratch(directory, "held-out");
    const std::filesystem::path half_path = scratch.path() / "half.bake";
    write_every_other(bake, half_path);
    const BakeReader half(half_path);
    EncodeOptions options;
    options.precision = Precision::i16;
    EncodeTarget wanted;
    wanted.transfer_error = target;
    wanted.spectrum = BandPower::flat(bake.identity().layout.in_bands);
    const std::filesystem::path file = scratch.path() / "half.paim";
    encode_to_target(half, options, wanted, file);
    const Asset asset = read_paim(file);
    FilePoses poses(asset, half);

    const size_t num_lights = stage.lights().size();
    HeldOut result;
    result.target = target;
    result.num_kept = half.num_poses();
    result.num_measured = half.num_poses() - 1;
    result.encoded.seen.resize(num_lights);
    result.interpolated.seen.resize(num_lights);
    std::set<uint32_t> shown;  // numbers of in-between poses
    for (size_t j = 0; j < stage.poses().size(); ++j) {
        shown.insert(static_cast<uint32_t>(j * result.num_measured / stage.poses().size()));
    }
    // In the scene, without outliers and vertices that no face has.
    const std::vector<uint32_t> counted = face_vertices(bake.topology());
    const auto placed = [&](const DecodedPose& pose, uint32_t p) {
        const uint32_t num_vertices = bake.identity().num_vertices;
        std::vector<float> planes = pose.positions;
        stage.outliers().replace(p, num_vertices, 0, planes);
        move_to_scene(pose.root, planes, pose.num_following);
        keep_vertices(planes, num_vertices, counted);
        return planes;
    };
    const DecodedPose* const still = poses.still();
    for (uint32_t j = 0; j < result.num_measured; ++j) {
        const uint32_t p = 2 * j + 1;
        const auto read = [&](uint32_t q) { return baked_pose(bake, q, bake.read_pose(q)); };
        const DecodedPose truth = read(p);
        const bool is_shown = shown.count(j) > 0;
        const std::vector<Image> expected =
            is_shown ? stage.render_pose(truth) : std::vector<Image>();
        const auto add = [&](const DecodedPose& pose, const DecodedPose* around,
                             InBetweenError& error) {
            error.distance.add(placed(pose, p), placed(truth, p), p);
            // Bands that the file does not have are none of the in-betweens' fault.
            DecodedPose kept = truth;
            keep_bands(kept, pose.layout.in_bands);
            if (kept.transfer.size() == pose.transfer.size()) {
                error.transfer.add(pose.transfer, kept.transfer, p);
            }
            if (!is_shown) return;
            const std::vector<Image> pictures = stage.render_pose(pose, around);
            for (size_t k = 0; k < pictures.size(); ++k) {
                error.seen[k % num_lights].add(compare_images(pictures[k], expected[k]), p,
                                               k / num_lights);
            }
        };
        add(poses.pose(j + 0.5), still, result.encoded);
        add(halfway(read(p - 1), read(p + 1)), nullptr, result.interpolated);
        on_pose();
    }
    for (InBetweenError* error : {&result.encoded, &result.interpolated}) {
        error->distance.worst_vertex = counted[error->distance.worst_vertex];
    }
    return result;
}

}  // namespace paim
