// Normals of decoded poses.
#include "player/inspect/pose_normals.h"

#include <algorithm>
#include <limits>

#include "paim/base/parallel.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/places.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/seams.h"
#include "player/inspect/sample_times.h"

namespace paim::player {

PoseNormals::PoseNormals(const CodedMesh& mesh)
    : mesh_(mesh), topology_(without_duplicate_faces(mesh.topology)), seams_(seams()) {}

std::vector<Vec3f> PoseNormals::at(double time, uint32_t num_geometry_components) {
    std::vector<Vec3f> normals =
        vertex_normals(topology_, positions(time, num_geometry_components), seams_);
    const RigidTransform root = root_at(mesh_.root_motion, time);
    if (!root.turns()) return normals;
    const Eigen::Matrix3f rotation = root.rotation.toRotationMatrix().cast<float>();
    constexpr size_t kVerticesAtOnce = 16384;
    const size_t num_turned = std::min<size_t>(normals.size(), mesh_.num_following);
    parallel_for(num_turned, kVerticesAtOnce, [&](size_t first, size_t end) {
        for (size_t v = first; v < end; ++v) normals[v] = rotation * normals[v];
    });
    return normals;
}

std::vector<Vec3f> PoseNormals::positions(double time, uint32_t num_geometry_components) {
    decoder_.decode(mesh_.positions, time, num_geometry_components, planes_);
    return from_planes(planes_);
}

// Vertices share a place if they lie at the same one in a few poses, with all components.
std::vector<uint32_t> PoseNormals::seams() {
    constexpr uint32_t kAllComponents = std::numeric_limits<uint32_t>::max();
    std::vector<Vec3f> first_pose;
    std::vector<uint32_t> places;
    constexpr uint32_t kPoses = 4;
    for (const double time : sample_times(mesh_.positions.num_poses, kPoses)) {
        const std::vector<Vec3f> pose = positions(time, kAllComponents);
        places = first_at_position(pose, places);
        if (places.empty()) return {};
        if (first_pose.empty()) first_pose = pose;
    }
    return find_seams(topology_, places, first_pose);
}

}  // namespace paim::player
