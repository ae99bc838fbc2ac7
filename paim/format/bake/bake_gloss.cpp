// The glossy transfer of a bake as a bake of its own.
#include <utility>

#include "paim/base/error.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// The glossy rows of the still mesh, as one of its own.
BakedStillMesh gloss_of(const BakedStillMesh& whole) {
    const std::vector<uint32_t> rows = glossy_rows(whole.topology, whole.materials);
    BakedStillMesh gloss;
    gloss.topology = faces_among(whole.topology, rows);
    gloss.albedo = tints_of(whole.materials, rows);
    gloss.pose.positions = whole.pose.positions;
    gloss.pose.normals = whole.pose.normals;
    keep_vertices(gloss.pose.positions, whole.topology.num_vertices, rows);
    keep_vertices(gloss.pose.normals, whole.topology.num_vertices, rows);
    gloss.pose.transfer = whole.pose.gloss;
    gloss.pose.noise = whole.pose.gloss_noise;
    gloss.pose.statistics = whole.pose.statistics.of_gloss();
    return gloss;
}

}  // namespace

BakedPose BakeReader::read_gloss_pose(uint32_t p) const {
    BakedPose pose = whole_->read_pose(p);
    keep_vertices(pose.positions, whole_->identity_.num_vertices, whole_->gloss_rows_);
    keep_vertices(pose.normals, whole_->identity_.num_vertices, whole_->gloss_rows_);
    pose.transfer = std::move(pose.gloss);
    pose.noise = std::move(pose.gloss_noise);
    pose.gloss.clear();
    pose.gloss_noise.clear();
    pose.statistics = pose.statistics.of_gloss();
    return pose;
}

BakeReader BakeReader::gloss() const {
    if (gloss_rows_.empty()) {
        throw_unsupported("{}: no vertex of the poses is glossy", directory_.string());
    }
    BakeReader view = *this;
    view.whole_ = std::make_shared<BakeReader>(*this);
    view.identity_.layout = identity_.gloss->layout;
    view.identity_.gloss.reset();
    view.identity_.num_vertices = static_cast<uint32_t>(gloss_rows_.size());
    if (identity_.num_following != kAllVertices) {
        view.identity_.num_following =
            static_cast<uint32_t>(num_below(identity_.num_following, gloss_rows_));
    }
    if (view.identity_.num_following == view.identity_.num_vertices) {
        view.identity_.num_following = kAllVertices;
    }
    view.topology_ = faces_among(topology_, gloss_rows_);
    view.identity_.num_triangles = static_cast<uint32_t>(view.topology_.triangles.size());
    view.albedo_ = tints_of(materials_, gloss_rows_);
    view.materials_ = {};
    view.texture_ = {};
    view.gloss_rows_.clear();
    view.still_mesh_.reset();
    if (still_mesh_ && !still_mesh_->pose.gloss.empty()) {
        view.still_mesh_ = gloss_of(*still_mesh_);
    } else {
        view.identity_.still_meshes.clear();
    }
    return view;
}

}  // namespace paim
