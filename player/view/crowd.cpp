// A grid of instances.
#include "player/view/crowd.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

namespace {

constexpr double kGap = 0.1;        // between two copies, as a share of their size
constexpr double kLeastGap = 0.02;  // as a share of their largest extent: of what is flat
constexpr double kGoldenSection = 0.6180339887498949;

}  // namespace

std::vector<Instance> make_crowd(uint32_t count, const Bounds& reach, uint32_t num_poses) {
    if (count <= 1 || reach.empty()) return {Instance{}};
    const Vec3d extent = (reach.upper - reach.lower).cast<double>();
    const double largest = extent.maxCoeff() > 0.0 ? extent.maxCoeff() : 1.0;
    const Vec3d size = extent + (kGap * extent).cwiseMax(Vec3d::Constant(kLeastGap * largest));
    const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    // Cells in order of their distance from the middle one; of equal ones the front row first.
    std::vector<std::pair<int, int>> cells;
    const int half = static_cast<int>(columns / 2);
    for (int z = 0; z < static_cast<int>(columns); ++z) {
        for (int x = 0; x < static_cast<int>(columns); ++x) cells.emplace_back(x - half, half - z);
    }
    std::stable_sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
        return a.first * a.first + a.second * a.second < b.first * b.first + b.second * b.second;
    });
    std::vector<Instance> crowd(count);
    for (uint32_t i = 0; i < count; ++i) {
        crowd[i].offset = {cells[i].first * size.x(), 0.0, cells[i].second * size.z()};
        crowd[i].time_offset = std::fmod(i * kGoldenSection, 1.0) * num_poses;
    }
    return crowd;
}

Bounds crowd_bounds(const std::vector<Instance>& crowd, const Bounds& reach) {
    Bounds bounds;
    if (reach.empty()) return bounds;
    for (const Instance& instance : crowd) {
        const Vec3f offset = instance.offset.cast<float>();
        bounds.extend(Vec3f(reach.lower + offset));
        bounds.extend(Vec3f(reach.upper + offset));
    }
    return bounds;
}

}  // namespace paim::player
