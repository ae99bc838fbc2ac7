// Pictures by paths.
#pragma once

#include "analysis/reference/path/path_tracer.h"
#include "paim/image/image.h"
#include "paim/render/render.h"

namespace paim {

struct PathPicture {
    Image mean;
    Image standard_error;  // of each channel of each pixel
};

// Unit direction from what a pixel shows to the eye.
Vec3f towards_eye(const Camera& camera, const VisiblePoints& visible, size_t pixel);

// What the pixels show; black where no mesh is.
// visible  of the tracer's mesh through the camera
PathPicture trace_picture(const PathTracer& tracer, const VisiblePoints& visible,
                          const Camera& camera, const PathSettings& settings);

}  // namespace paim
