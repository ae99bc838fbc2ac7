// Interleaves planes, four at a time.
#include "player/render/group_gather.h"

#include <algorithm>

#include "player/render/upload_plan.h"

namespace paim::player {

void gather_groups(uint32_t num_vertices, const std::function<Lane(uint32_t, uint32_t)>& lane_of,
                   int64_t first, std::span<float> out) {
    int64_t texel = first;
    const int64_t end = first + static_cast<int64_t>(out.size() / kGroupSize);
    float* target = out.data();
    while (texel < end) {
        const auto group = static_cast<uint32_t>(texel / num_vertices);
        const auto first_vertex = static_cast<size_t>(texel % num_vertices);
        const auto count = std::min(num_vertices - first_vertex, static_cast<size_t>(end - texel));
        for (uint32_t j = 0; j < kGroupSize; ++j) {
            const Lane lane = lane_of(group, j);
            if (lane.values == nullptr) {
                for (size_t v = 0; v < count; ++v) target[v * kGroupSize + j] = 0.0f;
                continue;
            }
            const size_t start = lane.first + first_vertex;
            lane.values->for_each(start, count, [&](size_t at, float value) {
                target[(at - start) * kGroupSize + j] = value;
            });
        }
        texel += static_cast<int64_t>(count);
        target += count * kGroupSize;
    }
}

Lane PlaneGroups::lane(const StoredValues& values, uint32_t group, uint32_t lane) const {
    const uint32_t channel = group / groups_per_channel;
    const uint32_t plane = group % groups_per_channel * kGroupSize + lane;
    if (plane >= planes_used) return {};
    return {&values, (size_t{channel} * planes_per_channel + plane) * num_vertices};
}

}  // namespace paim::player
