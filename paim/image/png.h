// PNG output.
#pragma once

#include <filesystem>

#include "paim/image/image.h"
#include "paim/image/tone.h"

namespace paim {

// Writes an 8-bit RGB PNG, all or nothing. Errors: output failed.
void write_png(const std::filesystem::path& path, const Image& image, const ToneCurve& curve = {});

}  // namespace paim
