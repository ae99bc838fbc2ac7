// Averages an image down while its rows arrive, so that the whole of it is never in memory.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/image/image.h"

namespace paim {

// What a row of pixels counts in an average.
enum class RowArea {
    equal,    // as its height in the image
    latlong,  // as its solid angle, if the image is a lat-long map (docs/conventions.md)
};

// Each pixel of the small image is the mean of what it covers of the large one. The sum of all
// pixels, weighted by their areas, is the same in both, but for rounding to float.
class AreaAverage {
  public:
    // to_width, to_height  1 … width, 1 … height. Equal sizes copy.
    AreaAverage(int width, int height, int to_width, int to_height, RowArea rows);

    // Adds pixels of row y from column x on. Each pixel is added once; those that are never added
    // are black.
    void add(int x, int y, std::span<const Vec3f> pixels);

    // The small image; call it once, at the end.
    Image take() { return std::move(image_); }

  private:
    // A pixel of the large image along one axis: it covers `share` of the small pixel `first`, and
    // `next_share` of the one after it.
    struct Cover {
        int first;
        float share, next_share;
    };
    static std::vector<Cover> covers(int from, int to, RowArea area);
    void add_to_row(int x, int row, float share, std::span<const Vec3f> pixels);

    Image image_;
    std::vector<Cover> columns_, rows_;
};

// The map itself, or averaged down to fit into the size.
// max_width, max_height  at least 1
Image fit_latlong(const Image& map, int max_width, int max_height);

}  // namespace paim
