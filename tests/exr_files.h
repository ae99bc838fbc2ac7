// OpenEXR files with attributes, which Paim itself does not write.
#pragma once

#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfEnvmap.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>

#include <filesystem>
#include <functional>

#include "paim/image/image.h"

namespace paim {

// Writes floats, with a header that `describe` may add to.
inline void write_exr_with(const std::filesystem::path& path, const Image& image,
                           const std::function<void(Imf::Header&)>& describe = {}) {
    Imf::Header header(image.width, image.height);
    if (describe) describe(header);
    Imf::FrameBuffer buffer;
    char* origin = reinterpret_cast<char*>(const_cast<Vec3f*>(image.pixels.data()));
    const char* const names[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(names[c], Imf::Slice(Imf::FLOAT, origin + c * sizeof(float), sizeof(Vec3f),
                                           sizeof(Vec3f) * static_cast<size_t>(image.width)));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(image.height);
}

inline void mark_as_cube(Imf::Header& header) {
    Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
}

// The primaries and the white of ACES 2065-1, AP0.
inline void mark_as_ap0(Imf::Header& header) {
    Imf::addChromaticities(
        header, {{0.7347f, 0.2653f}, {0.0f, 1.0f}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}});
}

}  // namespace paim
