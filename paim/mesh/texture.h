// Images on the faces of a mesh: the diffuse colour of each pixel.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"

namespace paim {

// The most images and coordinates of a mesh.
constexpr size_t kMaxImages = 65535;
constexpr size_t kMaxCoordinates = (size_t{1} << 32) - 1;

// A PNG or JPEG file, as it was.
struct TextureImage {
    std::string name;            // of the file, without its folder
    std::vector<uint8_t> bytes;  // of the whole file

    bool operator==(const TextureImage&) const = default;
};

// Texture coordinates belong to corners of faces, so that seams of a texture split no vertex.
// u grows to the right of the image and v upwards; the image repeats outside 0..1.
struct Texture {
    std::vector<TextureImage> images;
    std::vector<Vec2f> coordinates;  // [T]
    // [F] the coordinates of the corners of each triangle; 0 0 0 without an image
    std::vector<Triangle> corners;
    std::vector<uint16_t> image_of_face;  // [F] 0: none; n: images[n − 1]
    // [images] Linear colour, 0..1, that multiplies the colours of an image: the Kd of its material.
    std::vector<Vec3f> factors;

    bool empty() const { return images.empty(); }
    uint64_t size_bytes() const;  // in memory

    // Adds the other, of `num_other` faces, after this one of `num_own` faces. An image with the
    // same factor is kept once. Both together have at most kMaxImages images and
    // kMaxCoordinates coordinates (checked).
    void append(const Texture& other, size_t num_own, size_t num_other);

    bool operator==(const Texture&) const = default;
};

}  // namespace paim
