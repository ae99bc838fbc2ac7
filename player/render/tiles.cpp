// Pictures cut into tiles.
#include "player/render/tiles.h"

#include <algorithm>
#include <cstdint>

#include "paim/base/check.h"

namespace paim::player {

PictureRegion Tiling::region(int column, int row) const {
    const auto share = [](int part, int whole) {
        return static_cast<float>(static_cast<double>(part) / whole);
    };
    const int below = picture_height - (row + 1) * tile_height;  // below 0: beyond the picture
    return {share(column * tile_width, picture_width), share(below, picture_height),
            share(tile_width, picture_width), share(tile_height, picture_height)};
}

Tiling plan_tiles(int width, int height, int samples, int max_target_size) {
    PAIM_CHECK(width >= 1 && height >= 1 && samples >= 1 && samples <= max_target_size);
    constexpr int64_t kMostSamples = int64_t{1} << 26;
    constexpr int kTileSamples = 4096;
    const int64_t all_width = int64_t{width} * samples, all_height = int64_t{height} * samples;
    if (std::max(all_width, all_height) <= max_target_size &&
        all_width * all_height <= kMostSamples) {
        return {width, height, width, height};
    }
    const int side = std::max(1, std::min(kTileSamples, max_target_size) / samples);
    return {width, height, std::min(width, side), std::min(height, side)};
}

int samples_that_fit(int width, int height, int samples, int max_target_size) {
    return std::clamp(max_target_size / std::max(width, height), 1, samples);
}

}  // namespace paim::player
