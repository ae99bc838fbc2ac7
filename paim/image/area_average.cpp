// Averages an image down while its rows arrive.
#include "paim/image/area_average.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

// The area above the part t of the height, 0 … 1, in units that do not matter.
double area_above(double t, RowArea area) {
    return area == RowArea::latlong ? -std::cos(kPi * t) : t;
}

}  // namespace

std::vector<AreaAverage::Cover> AreaAverage::covers(int from, int to, RowArea area) {
    PAIM_CHECK_LE(1, to);
    PAIM_CHECK_LE(to, from);
    // Edges at the same place are the same number, so that equal sizes have shares of 1 and 0.
    const auto edge = [&](int i, int count) {
        return area_above(static_cast<double>(i) / count, area);
    };
    std::vector<Cover> result;
    for (int i = 0; i < from; ++i) {
        const int j = static_cast<int>(int64_t{i} * to / from);
        const double top = edge(i, from);
        const double bottom = edge(i + 1, from);
        const double end = edge(j + 1, to);
        Cover cover{j, 0.0f, 0.0f};
        cover.share = static_cast<float>((std::min(bottom, end) - top) / (end - edge(j, to)));
        if (bottom > end && j + 1 < to) {
            cover.next_share = static_cast<float>((bottom - end) / (edge(j + 2, to) - end));
        }
        result.push_back(cover);
    }
    return result;
}

AreaAverage::AreaAverage(int width, int height, int to_width, int to_height, RowArea rows)
    : image_(to_width, to_height),
      columns_(covers(width, to_width, RowArea::equal)),
      rows_(covers(height, to_height, rows)) {}

void AreaAverage::add(int x, int y, std::span<const Vec3f> pixels) {
    PAIM_CHECK_LE(static_cast<size_t>(x) + pixels.size(), columns_.size());
    const Cover& row = rows_[static_cast<size_t>(y)];
    add_to_row(x, row.first, row.share, pixels);
    if (row.next_share > 0.0f) add_to_row(x, row.first + 1, row.next_share, pixels);
}

void AreaAverage::add_to_row(int x, int row, float share, std::span<const Vec3f> pixels) {
    const Cover* cover = columns_.data() + x;
    for (const Vec3f& pixel : pixels) {
        Vec3f* to = &image_.at(cover->first, row);
        to[0] += share * cover->share * pixel;
        if (cover->next_share > 0.0f) to[1] += share * cover->next_share * pixel;
        ++cover;
    }
}

Image fit_latlong(const Image& map, int max_width, int max_height) {
    PAIM_CHECK_LE(1, max_width);
    PAIM_CHECK_LE(1, max_height);
    if (map.width <= max_width && map.height <= max_height) return map;
    AreaAverage average(map.width, map.height, std::min(map.width, max_width),
                        std::min(map.height, max_height), RowArea::latlong);
    for (int y = 0; y < map.height; ++y) {
        average.add(0, y, {&map.at(0, y), static_cast<size_t>(map.width)});
    }
    return average.take();
}

}  // namespace paim
