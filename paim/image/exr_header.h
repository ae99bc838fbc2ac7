// Checks an EXR file's headers before OpenEXR allocates memory by them.
// Based on: The OpenEXR File Layout, https://openexr.com/en/latest/OpenEXRFileLayout.html
#pragma once

#include <filesystem>

#include "paim/image/exr.h"

namespace paim {

// Whether the file can be read and begins as OpenEXR files do.
bool is_exr(const std::filesystem::path& path);

// Walks the headers of all parts and checks everything that sizes an allocation against the limits
// and the length of the file: attributes, windows, tiles, chunks and their table. For a file that
// passes, OpenEXR allocates at most a few times 128 MiB in addition to the image.
// Errors (bad input) name the file: missing, not EXR, ended too early, inconsistent, larger than
// the limits, deep. OpenEXR itself checks the pixels.
void check_exr_header(const std::filesystem::path& path, const ExrLimits& limits);

}  // namespace paim
