// Interleaves planes, four at a time.
#include "player/render/group_gather.h"

#include <algorithm>
#include <variant>

#include "player/render/upload_plan.h"

namespace paim::player {

namespace {

// Values `start` … `start` + count − 1 into every fourth place of `out`.
template <typename Value>
void gather_lane(const StoredValues& values, size_t start, size_t count, Value* out) {
    std::visit(
        [&](const auto& stored) {
            for (size_t v = 0; v < count; ++v) {
                out[v * kGroupSize] = static_cast<Value>(stored[start + v]);
            }
        },
        values.values());
}

}  // namespace

template <typename Value>
void gather_groups(uint32_t num_vertices, const std::function<Lane(uint32_t, uint32_t)>& lane_of,
                   int64_t first, std::span<Value> out) {
    int64_t texel = first;
    const int64_t end = first + static_cast<int64_t>(out.size() / kGroupSize);
    Value* target = out.data();
    while (texel < end) {
        const auto group = static_cast<uint32_t>(texel / num_vertices);
        const auto first_vertex = static_cast<size_t>(texel % num_vertices);
        const auto count = std::min(num_vertices - first_vertex, static_cast<size_t>(end - texel));
        for (uint32_t j = 0; j < kGroupSize; ++j) {
            const Lane lane = lane_of(group, j);
            if (lane.values == nullptr) {
                for (size_t v = 0; v < count; ++v) target[v * kGroupSize + j] = Value{0};
                continue;
            }
            gather_lane(*lane.values, lane.first + first_vertex, count, target + j);
        }
        texel += static_cast<int64_t>(count);
        target += count * kGroupSize;
    }
}

template void gather_groups(uint32_t, const std::function<Lane(uint32_t, uint32_t)>&, int64_t,
                            std::span<float>);
template void gather_groups(uint32_t, const std::function<Lane(uint32_t, uint32_t)>&, int64_t,
                            std::span<int16_t>);
template void gather_groups(uint32_t, const std::function<Lane(uint32_t, uint32_t)>&, int64_t,
                            std::span<int8_t>);

Lane PlaneGroups::lane(const StoredValues& values, uint32_t group, uint32_t lane) const {
    const uint32_t channel = group / groups_per_channel;
    const uint32_t plane = group % groups_per_channel * kGroupSize + lane;
    if (plane >= planes_used) return {};
    return {&values, (size_t{channel} * planes_per_channel + plane) * num_vertices};
}

}  // namespace paim::player
