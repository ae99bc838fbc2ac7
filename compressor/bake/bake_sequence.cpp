// Bakes a whole sequence, pose by pose.
#include "compressor/bake/bake_sequence.h"

#include <algorithm>
#include <future>
#include <ranges>
#include <utility>

#include "compressor/bake/gloss_to_frames.h"
#include "compressor/bake/local_pose.h"
#include "compressor/scene/isolated_at_rest.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// Reads a pose while another one is baked, because reading uses one core only.
class ReadAhead {
  public:
    // near_body  whether positions are relative to the offsets of poses, or to the origin
    ReadAhead(const PoseSource& source, bool near_body) : source_(source), near_body_(near_body) {}

    void start(uint32_t p) {
        if (max_parallelism() < 2) return;
        pose_number_ = p;
        pose_ = std::async(std::launch::async, [this, p] { return load(p); });
    }

    // Returns pose p, whether reading it was started or not. Errors: those of the source.
    Pose take(uint32_t p) {
        if (pose_.valid() && pose_number_ == p) return pose_.get();
        return load(p);
    }

  private:
    Pose load(uint32_t p) const {
        return near_body_ ? source_.load_pose(p) : load_from_origin(source_, p);
    }

    const PoseSource& source_;
    const bool near_body_;
    uint32_t pose_number_ = 0;
    std::future<Pose> pose_;
};

// Moves a pose to local coordinates, where isolated vertices are at the place that they have in the
// first pose.
void move_to_local(const IsolatedAtRest& source, const RootMotion& root_motion, uint32_t p,
                   const Vec3d& offset, const TransferLayout& layout, BakedPose& baked) {
    move_to_local(root_motion[p], offset, layout, baked, source.num_moving_vertices());
    const Vec3d at_rest = source.place().cast<double>() + source.pose_offset(0);
    const Vec3f place = root_motion[0].to_local(at_rest).cast<float>();
    const size_t num_vertices = source.topology().num_vertices;
    for (const uint32_t v : source.isolated()) {
        for (size_t axis = 0; axis < 3; ++axis) {
            baked.positions[axis * num_vertices + v] = place[static_cast<int>(axis)];
        }
    }
}

// Adds those materials that are not there yet.
void add_materials(const std::vector<GlossMaterial>& from, std::vector<GlossMaterial>& to) {
    for (const GlossMaterial& material : from) {
        if (std::ranges::find(to, material) == to.end()) to.push_back(material);
    }
}

// Rows of glossy transfer of what moves: they are the first.
uint32_t num_following_rows(const PoseSource& source) {
    const std::vector<uint32_t> rows = glossy_rows(source.topology(), source.materials());
    const auto end = std::ranges::lower_bound(rows, source.num_moving_vertices());
    return static_cast<uint32_t>(end - rows.begin());
}

// The offset of a pose to the origin of its root motion.
Vec3d offset_of(const PoseSource& source, uint32_t p, bool near_body) {
    return near_body ? source.pose_offset(p) : Vec3d::Zero();
}

// Frames of the glossy rows, by the first pose as it is stored. Gloss that nothing bakes needs none.
RowFrames frames_of_rows(const PoseSource& source, const RootMotion& root_motion, bool near_body) {
    if (source.materials().empty()) return {source.topology(), {}, {}};
    BakedPose first;
    first.positions =
        to_planes((near_body ? source.load_pose(0) : load_from_origin(source, 0)).positions);
    if (!root_motion.empty()) {
        const TransferLayout none{TransferKind::diffuse, 1};
        move_to_local(root_motion[0], offset_of(source, 0, near_body), none, first,
                      source.num_moving_vertices());
    }
    return {source.topology(), source.materials(), first.positions};
}

// Turns gloss, which is in the axes of the scene, into frames of a pose that is in local axes.
void gloss_to_local_frames(const RigidTransform& root, const TransferLayout& layout,
                           const RowFrames& row_frames, uint32_t num_following_rows,
                           BakedPose& baked) {
    std::vector<Eigen::Matrix3f> frames = row_frames.at(baked);
    const Eigen::Matrix3f to_scene = root.rotation.toRotationMatrix().cast<float>();
    for (size_t r = 0; r < std::min<size_t>(num_following_rows, frames.size()); ++r) {
        frames[r] = to_scene * frames[r];
    }
    gloss_to_frames(layout, frames, baked);
    turn_gloss(root, layout, baked, num_following_rows);
}

}  // namespace

BakeIdentity bake_identity(const PoseSource& source, const BakeOptions& options,
                           const std::string& normals, const Surroundings& surroundings,
                           const RootMotion& root_motion) {
    BakeIdentity identity;
    const StillMesh& still_mesh = surroundings.still_mesh;
    const Materials& materials = source.materials();
    identity.layout = TransferBaker::bake_layout(options, source.albedo(), still_mesh, materials);
    if (const auto layout =
            TransferBaker::gloss_layout(options, source.albedo(), still_mesh, materials)) {
        identity.gloss = GlossIdentity{layout->in_frames(), materials.glossy};
        add_materials(still_mesh.materials.glossy, identity.gloss->materials);
    }
    identity.baker = baker_version(options.sampler, identity.gloss.has_value());
    identity.bounces = options.bounces;
    identity.sampler = sampler_name(options.sampler);
    identity.streams = streams_name(options.streams);
    identity.rays = options.rays;
    identity.transfer_error = options.transfer_error;
    identity.seed = options.seed;
    identity.normals = normals;
    identity.floor = surroundings.floor;
    identity.still_meshes = still_mesh.sources;
    identity.num_vertices = source.topology().num_vertices;
    identity.num_triangles = static_cast<uint32_t>(source.topology().triangles.size());
    identity.mesh_xxh3 =
        mesh_checksum(source.topology(), source.albedo(), source.texture(), source.materials());
    identity.origin = source.origin();
    identity.root_motion = root_motion;
    const uint32_t num_moving = source.num_moving_vertices();
    if (!root_motion.empty() && num_moving < identity.num_vertices) {
        identity.num_following = num_moving;
    }
    for (uint32_t p = 0; p < source.num_poses(); ++p) {
        // The name without its folder, so that a bake does not depend on the place of the files.
        const std::string name = std::filesystem::path(source.pose_name(p)).filename().string();
        identity.poses.push_back({name, source.pose_checksum(p)});
    }
    return identity;
}

BakeSummary bake_sequence(const PoseSource& given, const BakeOptions& options,
                          const std::string& normals, const std::filesystem::path& directory,
                          uint32_t first, uint32_t last,
                          const std::function<void(uint32_t)>& on_pose,
                          const Surroundings& surroundings, const RootMotion& root_motion) {
    PAIM_CHECK(root_motion.empty() || root_motion.size() == given.num_poses());
    PAIM_CHECK_LE(first, last);
    PAIM_CHECK_LT(last, given.num_poses());
    const IsolatedAtRest source(given);
    const BakeIdentity identity =
        bake_identity(source, options, normals, surroundings, root_motion);
    const BakeWriter writer(directory, identity, source.topology(), source.albedo(),
                            source.texture(), source.materials());
    TransferBaker baker(options, source.albedo(), surroundings.still_mesh, source.materials());
    const auto lacks = [&](uint32_t p) { return !writer.has_pose(p); };
    if (const StillMesh& still_mesh = surroundings.still_mesh; !still_mesh.empty()) {
        const bool found = writer.has_still_mesh();
        // Poses need the light of the still meshes if it bounces.
        const auto poses = std::views::iota(first, last + 1);
        const bool needed = options.bounces > 0 && std::any_of(poses.begin(), poses.end(), lacks);
        if (!found || needed) {
            BakedPose baked = baker.bake_still_mesh();
            if (identity.gloss) {
                const RowFrames frames(still_mesh.topology, still_mesh.materials, baked.positions);
                gloss_to_frames(identity.gloss->layout, frames.at(baked), baked);
            }
            if (!found) {
                writer.write_still_mesh({still_mesh.topology, still_mesh.albedo, std::move(baked),
                                         still_mesh.materials, still_mesh.texture});
            }
        }
    }
    // Rays are traced in the coordinates of the floor and the still meshes, or else near the body.
    const bool near_body = !root_motion.empty() && surroundings.still_mesh.empty() &&
                           identity.num_following == kAllVertices;
    const RowFrames frames = frames_of_rows(source, root_motion, near_body);
    ReadAhead ahead(source, near_body);
    BakeSummary summary;
    std::vector<PoseStatistics> poses;
    for (uint32_t p = first; p <= last; ++p) {
        PoseStatistics statistics;
        if (writer.has_pose(p)) {
            statistics = writer.read_statistics(p);
            ++summary.resumed;
        } else {
            const Pose pose = ahead.take(p);
            if (p < last && !writer.has_pose(p + 1)) ahead.start(p + 1);
            BakedPose baked = baker.bake(source.topology(), pose, p);
            baked.statistics.mesh = report_pose(source.topology(), pose.positions);
            if (!root_motion.empty()) {
                move_to_local(source, root_motion, p, offset_of(source, p, near_body),
                              identity.layout, baked);
            }
            if (identity.gloss) {
                gloss_to_local_frames(root_at(root_motion, p), identity.gloss->layout, frames,
                                      num_following_rows(source), baked);
            }
            writer.write_pose(p, baked);
            statistics = baked.statistics;
            ++summary.baked;
        }
        poses.push_back(statistics);
        on_pose(p);
    }
    summary.total = combine(poses);
    return summary;
}

}  // namespace paim
