// Texture coordinates of the corners of triangles.
#include "compressor/io/texture_corners.h"

#include <algorithm>
#include <utility>

#include "paim/base/check.h"

namespace paim {

CornerFinder::CornerFinder(const Polygons& polygons)
    : polygons_(polygons), sorted_polygon_(static_cast<uint32_t>(polygons.num_faces())) {
    uint32_t first = 0;
    for (const uint32_t size : polygons.sizes) {
        first_corner_.push_back(first);
        first += size;
    }
}

Triangle CornerFinder::find(uint32_t polygon, const Triangle& vertices) {
    PAIM_CHECK_LT(polygon, polygons_.num_faces());
    if (polygon != sorted_polygon_) {
        sorted_polygon_ = polygon;
        sorted_.clear();
        for (uint32_t i = 0; i < polygons_.sizes[polygon]; ++i) {
            const uint32_t index = first_corner_[polygon] + i;
            sorted_.push_back({polygons_.corners[index], index});
        }
        std::sort(sorted_.begin(), sorted_.end(), [](const Corner& a, const Corner& b) {
            return std::pair(a.vertex, a.index) < std::pair(b.vertex, b.index);
        });
    }
    Triangle corners{};
    for (size_t k = 0; k < 3; ++k) {
        const auto found = std::lower_bound(
            sorted_.begin(), sorted_.end(), vertices[k],
            [](const Corner& corner, uint32_t vertex) { return corner.vertex < vertex; });
        PAIM_CHECK(found != sorted_.end() && found->vertex == vertices[k]);
        corners[k] = found->index;
    }
    return corners;
}

}  // namespace paim
