// A pose sequence held in memory.
#include "paim/mesh/pose_set.h"

#include <fmt/format.h>

#include <utility>

#include "paim/base/check.h"
#include "paim/base/hash.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/places.h"
#include "paim/mesh/seams.h"

namespace paim {

PoseSet::PoseSet(Topology topology, std::vector<std::vector<Vec3f>> positions, Albedo albedo)
    : topology_(std::move(topology)),
      distinct_(without_duplicate_faces(topology_)),
      positions_(std::move(positions)),
      albedo_(std::move(albedo)) {
    PAIM_CHECK(!positions_.empty());
    for (const auto& pose : positions_) PAIM_CHECK_EQ(pose.size(), topology_.num_vertices);
    PAIM_CHECK(albedo_.values.size() == 1 || albedo_.values.size() == topology_.num_vertices);
    std::vector<uint32_t> places = first_at_position(positions_[0]);
    for (size_t p = 1; p < positions_.size() && !places.empty(); ++p) {
        places = first_at_position(positions_[p], places);
    }
    seams_ = find_seams(distinct_, places, positions_[0]);
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
