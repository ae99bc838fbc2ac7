// Interleaves planes, four at a time.
#include "player/render/group_gather.h"

#include <algorithm>

#include "player/render/upload_plan.h"

namespace paim::player {

void gather_groups(const PlaneView& view, int64_t first, std::span<float> out) {
    const int64_t num_vertices = view.num_vertices;
    int64_t texel = first;
    const int64_t end = first + static_cast<int64_t>(out.size() / kGroupSize);
    float* target = out.data();
    while (texel < end) {
        const int64_t group = texel / num_vertices;
        const int64_t first_vertex = texel % num_vertices;
        const int64_t count = std::min(num_vertices - first_vertex, end - texel);
        const auto channel = static_cast<uint32_t>(group / view.groups_per_channel);
        const auto first_plane =
            static_cast<uint32_t>(group % view.groups_per_channel) * kGroupSize;
        for (uint32_t lane = 0; lane < kGroupSize; ++lane) {
            const uint32_t plane = first_plane + lane;
            if (plane >= view.planes_used) {
                for (int64_t v = 0; v < count; ++v) target[v * kGroupSize + lane] = 0.0f;
                continue;
            }
            const int64_t source_plane = int64_t{channel} * view.planes_per_channel + plane;
            const float step =
                view.steps.empty() ? 1.0f : view.steps[static_cast<size_t>(source_plane)];
            const auto first_value =
                static_cast<size_t>(source_plane * num_vertices + first_vertex);
            view.values->for_each(first_value, static_cast<size_t>(count),
                                  [&](size_t j, float value) {
                                      target[(j - first_value) * kGroupSize + lane] = step * value;
                                  });
        }
        texel += count;
        target += count * kGroupSize;
    }
}

}  // namespace paim::player
