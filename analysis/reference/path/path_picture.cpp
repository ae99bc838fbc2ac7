// Pictures by paths.
#include "analysis/reference/path/path_picture.h"

namespace paim {

Vec3f towards_eye(const Camera& camera, const VisiblePoints& visible, size_t pixel) {
    const auto width = static_cast<float>(visible.width),
               height = static_cast<float>(visible.height);
    const size_t row = static_cast<size_t>(visible.width);
    return -camera.ray_direction((static_cast<float>(pixel % row) + 0.5f) / width,
                                 (static_cast<float>(pixel / row) + 0.5f) / height, width / height);
}

PathPicture trace_picture(const PathTracer& tracer, const VisiblePoints& visible,
                          const Camera& camera, const PathSettings& settings) {
    std::vector<PathStart> starts;
    std::vector<size_t> pixels;
    for (size_t pixel = 0; pixel < visible.hits.size(); ++pixel) {
        const Hit& hit = visible.hits[pixel];
        if (hit.triangle == kNoTriangle) continue;
        starts.push_back({{hit.triangle, hit.u, hit.v}, towards_eye(camera, visible, pixel)});
        pixels.push_back(pixel);
    }
    const std::vector<PathEstimate> estimates = tracer.trace(starts, settings);
    PathPicture picture{Image(visible.width, visible.height), Image(visible.width, visible.height)};
    for (size_t j = 0; j < pixels.size(); ++j) {
        picture.mean.pixels[pixels[j]] = estimates[j].mean;
        picture.standard_error.pixels[pixels[j]] = estimates[j].standard_error;
    }
    return picture;
}

}  // namespace paim
