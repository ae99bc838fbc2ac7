// What a bake found out about itself.
#include "paim/format/pose_statistics.h"

#include <cmath>

namespace paim {

PoseStatistics combine(std::span<const PoseStatistics> poses) {
    PoseStatistics total;
    if (poses.empty()) return total;
    double transfer_energy = 0.0;
    double noise_energy = 0.0;
    for (const PoseStatistics& pose : poses) {
        total.rays += pose.rays;
        total.blocked += pose.blocked;
        total.zero_normals += pose.zero_normals;
        total.mesh.zero_area_faces += pose.mesh.zero_area_faces;
        total.mesh.coincident_faces += pose.mesh.coincident_faces;
        transfer_energy += pose.transfer_rms * pose.transfer_rms;
        noise_energy += pose.noise_rms * pose.noise_rms;
    }
    const auto num_poses = static_cast<double>(poses.size());
    total.transfer_rms = std::sqrt(transfer_energy / num_poses);
    total.noise_rms = std::sqrt(noise_energy / num_poses);
    return total;
}

}  // namespace paim
