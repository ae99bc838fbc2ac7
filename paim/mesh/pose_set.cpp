// A pose sequence held in memory.
#include "paim/mesh/pose_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/hash.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/seams.h"
#include "paim/mesh/sequence_places.h"

namespace paim {

PoseSet::PoseSet(Topology topology, std::vector<std::vector<Vec3f>> positions, Albedo albedo)
    : topology_(std::move(topology)),
      distinct_(without_duplicate_faces(topology_)),
      positions_(std::move(positions)),
      albedo_(std::move(albedo)) {
    PAIM_CHECK(!positions_.empty());
    for (const auto& pose : positions_) PAIM_CHECK_EQ(pose.size(), topology_.num_vertices);
    PAIM_CHECK(albedo_.values.size() == 1 || albedo_.values.size() == topology_.num_vertices);
    find_seams();
}

void PoseSet::find_seams() {
    std::vector<uint32_t> corners;
    for (const Triangle& triangle : topology_.triangles) {
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    const auto in_double = [&](uint32_t p) {
        std::vector<Vec3d> positions;
        for (const Vec3f& x : positions_[p]) positions.push_back(x.cast<double>());
        return positions;
    };
    const auto bounds_of = [&](std::span<const Vec3d> positions) {
        BoundsD bounds;
        for (const uint32_t v : corners) bounds.extend(positions[v]);
        return usual_bounds(positions, corners, bounds);
    };
    const std::vector<uint32_t> chosen = reference_poses(num_poses());
    std::vector<std::vector<Vec3d>> positions;
    std::vector<SequencePlaces::Reference> references;
    for (const uint32_t p : chosen) positions.push_back(in_double(p));
    for (const auto& pose : positions) references.push_back({pose, bounds_of(pose)});
    SequencePlaces places(num_poses(), references);
    for (uint32_t p = 0; p < num_poses(); ++p) {
        if (std::find(chosen.begin(), chosen.end(), p) != chosen.end()) continue;
        const std::vector<Vec3d> pose = in_double(p);
        places.add(pose, bounds_of(pose));
    }
    seams_ = paim::find_seams(distinct_, places.finish(), positions_[0], places.longest_edge());
}

std::string PoseSet::pose_name(uint32_t p) const {
    return fmt::format("pose {}", p);
}

uint64_t PoseSet::pose_checksum(uint32_t p) const {
    return xxh3(positions_[p].data(), positions_[p].size() * sizeof(Vec3f));
}

Pose PoseSet::load_pose(uint32_t p) const {
    PAIM_CHECK_LT(p, num_poses());
    return {positions_[p], vertex_normals(distinct_, positions_[p], seams_)};
}

}  // namespace paim
