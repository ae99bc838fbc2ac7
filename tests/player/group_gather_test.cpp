// Planes to texels of four coefficients.
#include "player/render/group_gather.h"

#include <gtest/gtest.h>

#include <span>
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
                    first, std::span(out));
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

// Integers stay what they are at both ends of their range, also where two kinds share a texture.
TEST(GatherGroups, KeepsIntegers) {
    const StoredValues bytes = std::vector<int8_t>{-128, 127, 0, -1};
    const StoredValues words = std::vector<int16_t>{-32768, 32767, 129, -129};
    const auto lane_of = [&](uint32_t, uint32_t lane) {
        return lane == 0 ? Lane{&bytes, 0} : lane == 2 ? Lane{&words, 0} : Lane{};
    };
    std::vector<int16_t> both(16, 7);
    gather_groups(4, lane_of, 0, std::span(both));
    EXPECT_EQ(both, (std::vector<int16_t>{-128, 0, -32768, 0, 127, 0, 32767, 0, 0, 0, 129, 0, -1, 0,
                                          -129, 0}));
    const auto byte_lane = [&](uint32_t, uint32_t lane) {
        return lane == 1 ? Lane{&bytes, 0} : Lane{};
    };
    std::vector<int8_t> from_bytes(8, 7);
    gather_groups(4, byte_lane, 2, std::span(from_bytes));
    EXPECT_EQ(from_bytes, (std::vector<int8_t>{0, 0, 0, 0, 0, -1, 0, 0}));
}

}  // namespace
}  // namespace paim::player
