// Statistics of a bake.
#include "paim/format/bake/pose_statistics.h"

#include <cmath>
#include <limits>

#include "paim/base/check.h"

namespace paim {

namespace {

// The mean square over all coefficients, from the root mean square of each band.
double mean_square(std::span<const double> rms) {
    double energy = 0.0;
    for (size_t l = 0; l < rms.size(); ++l) {
        energy += static_cast<double>(2 * l + 1) * rms[l] * rms[l];
    }
    return rms.empty() ? 0.0 : energy / static_cast<double>(rms.size() * rms.size());
}

// Root mean square over poses, band by band.
std::vector<double> combine_rms(std::span<const PoseStatistics> poses,
                                std::vector<double> PoseStatistics::*rms) {
    std::vector<double> total((poses[0].*rms).size(), 0.0);
    for (const PoseStatistics& pose : poses) {
        PAIM_CHECK_EQ((pose.*rms).size(), total.size());
        for (size_t l = 0; l < total.size(); ++l) total[l] += (pose.*rms)[l] * (pose.*rms)[l];
    }
    for (double& value : total) value = std::sqrt(value / static_cast<double>(poses.size()));
    return total;
}

}  // namespace

double PoseStatistics::relative_noise() const {
    const double transfer = mean_square(transfer_rms);
    const double noise = mean_square(noise_rms);
    if (transfer == 0.0 && noise == 0.0) return std::numeric_limits<double>::quiet_NaN();
    return std::sqrt(noise / transfer);
}

PoseStatistics PoseStatistics::of_gloss() const {
    PoseStatistics gloss = *this;
    gloss.transfer_rms = gloss_rms;
    gloss.noise_rms = gloss_noise_rms;
    gloss.gloss_rms.clear();
    gloss.gloss_noise_rms.clear();
    return gloss;
}

std::vector<double> rms_by_band(const TransferLayout& layout, std::span<const float> planes) {
    const size_t num_vertices = planes.size() / layout.num_planes();
    PAIM_CHECK_EQ(planes.size(), num_vertices * layout.num_planes());
    std::vector<double> energy(layout.in_bands, 0.0);
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        double& sum = energy[layout.input_band(plane)];
        for (const float value : planes.subspan(plane * num_vertices, num_vertices)) {
            sum += static_cast<double>(value) * static_cast<double>(value);
        }
    }
    for (size_t l = 0; l < energy.size(); ++l) {
        const size_t count = layout.channels * layout.num_outgoing() * (2 * l + 1) * num_vertices;
        energy[l] = count > 0 ? std::sqrt(energy[l] / static_cast<double>(count)) : 0.0;
    }
    return energy;
}

PoseStatistics combine(std::span<const PoseStatistics> poses) {
    PoseStatistics total;
    if (poses.empty()) return total;
    for (const PoseStatistics& pose : poses) {
        total.rays += pose.rays;
        total.occluded += pose.occluded;
        total.back_hits += pose.back_hits;
        total.zero_normals += pose.zero_normals;
        total.above_target += pose.above_target;
        total.mesh.zero_area_faces += pose.mesh.zero_area_faces;
        total.mesh.coincident_faces += pose.mesh.coincident_faces;
    }
    total.transfer_rms = combine_rms(poses, &PoseStatistics::transfer_rms);
    total.noise_rms = combine_rms(poses, &PoseStatistics::noise_rms);
    total.gloss_rms = combine_rms(poses, &PoseStatistics::gloss_rms);
    total.gloss_noise_rms = combine_rms(poses, &PoseStatistics::gloss_noise_rms);
    return total;
}

}  // namespace paim
