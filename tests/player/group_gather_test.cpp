// Planes to texels of four coefficients.
#include "player/render/group_gather.h"

#include <gtest/gtest.h>

#include <vector>

namespace paim::player {
namespace {

// Two channels of 9 planes and 5 vertices; each value says where it is from.
constexpr uint32_t kVertices = 5;
constexpr uint32_t kPlanes = 9;

std::vector<float> make_planes() {
    std::vector<float> planes;
    for (uint32_t plane = 0; plane < 2 * kPlanes; ++plane) {
        for (uint32_t v = 0; v < kVertices; ++v) {
            planes.push_back(static_cast<float>(100 * plane + v + 1));
        }
    }
    return planes;
}

// Value of a lane by definition.
float expected(uint32_t texel, uint32_t lane, uint32_t planes_used, uint32_t groups_per_channel) {
    const uint32_t group = texel / kVertices, v = texel % kVertices;
    const uint32_t channel = group / groups_per_channel;
    const uint32_t plane = group % groups_per_channel * 4 + lane;
    return plane < planes_used ? static_cast<float>(100 * (channel * kPlanes + plane) + v + 1)
                               : 0.0f;
}

TEST(GatherGroups, PutsFourPlanesIntoATexelFromAnyStart) {
    const StoredValues planes = make_planes();
    for (const uint32_t planes_used : {9u, 4u, 1u}) {
        const uint32_t groups = (planes_used + 3) / 4;
        const PlaneGroups view{kVertices, 2, kPlanes, planes_used, groups};
        const uint32_t num_texels = 2 * groups * kVertices;
        for (uint32_t first = 0; first < num_texels; ++first) {
            for (uint32_t end = first + 1; end <= num_texels; ++end) {
                std::vector<float> out(4 * size_t{end - first}, -1.0f);
                gather_groups(
                    kVertices,
                    [&](uint32_t group, uint32_t lane) { return view.lane(planes, group, lane); },
                    first, out);
                for (uint32_t texel = first; texel < end; ++texel) {
                    for (uint32_t lane = 0; lane < 4; ++lane) {
                        ASSERT_EQ(out[4 * (texel - first) + lane],
                                  expected(texel, lane, planes_used, groups))
                            << planes_used << " planes, texel " << texel << ", lane " << lane;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace paim::player
