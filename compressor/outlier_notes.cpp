// What paim-compress says about outliers of a bake.
#include "compressor/outlier_notes.h"

#include <fmt/format.h>

#include <algorithm>

namespace paim {

namespace {

constexpr size_t kMostLines = 4;

// outliers  of one pose, at least one
const PositionOutlier& farthest(std::span<const PositionOutlier> outliers) {
    return *std::max_element(outliers.begin(), outliers.end(), [](const auto& a, const auto& b) {
        return a.distance() < b.distance();
    });
}

// Vertices count from 1, as in OBJ files and in messages about these.
std::string note(const BakeIdentity& bake, std::span<const PositionOutlier> outliers) {
    const PositionOutlier& worst = farthest(outliers);
    const Vec3d local = worst.position.cast<double>();
    const bool follows = worst.vertex < bake.num_following;
    const RigidTransform root = follows ? root_at(bake.root_motion, worst.pose) : RigidTransform();
    const Vec3d position = root.to_scene(local) + bake.origin;
    const std::string others =
        outliers.size() > 1
            ? fmt::format(" and {} more of {} vertices", outliers.size() - 1, bake.num_vertices)
            : "";
    return fmt::format(
        "{} (pose {}): vertex {}{} {} far beyond the rest of {} motion: at ({:.6g}, {:.6g}, "
        "{:.6g}), {:.4g} from where it is in the poses around; coded apart from the others",
        bake.poses[worst.pose].name, worst.pose, worst.vertex + 1, others,
        outliers.size() > 1 ? "are" : "is", outliers.size() > 1 ? "their" : "its", position.x(),
        position.y(), position.z(), worst.distance());
}

}  // namespace

std::vector<std::string> outlier_notes(const BakeIdentity& bake, const PositionOutliers& outliers) {
    std::vector<std::string> notes;
    const std::vector<uint32_t> poses = outliers.poses();
    for (const uint32_t pose : poses) {
        if (notes.size() == kMostLines) {
            notes.push_back(fmt::format("outliers in {} more poses (--json lists them)",
                                        poses.size() - kMostLines));
            break;
        }
        notes.push_back(note(bake, outliers.of_pose(pose)));
    }
    return notes;
}

nlohmann::ordered_json outliers_json(const BakeIdentity& bake, const PositionOutliers& outliers) {
    auto json = nlohmann::ordered_json::array();
    for (const uint32_t pose : outliers.poses()) {
        const auto of_pose = outliers.of_pose(pose);
        const PositionOutlier& worst = farthest(of_pose);
        json.push_back({{"pose", pose},
                        {"name", bake.poses[pose].name},
                        {"num_vertices", of_pose.size()},
                        {"vertex", worst.vertex},
                        {"distance", worst.distance()}});
    }
    return json;
}

}  // namespace paim
