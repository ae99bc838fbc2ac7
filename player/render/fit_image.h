// Images that textures can hold.
#pragma once

#include "paim/image/image.h"

namespace paim::player {

// The image itself, if neither side is longer than max_size; otherwise blocks of n × n pixels
// averaged to one, with the smallest n that is enough (blocks at the right and lower edge may be
// cut).
// max_size >= 1
Image fit_image(const Image& image, int max_size);

}  // namespace paim::player
