// Images on the faces of a mesh.
#include "paim/mesh/texture.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

uint64_t Texture::size_bytes() const {
    uint64_t size_bytes = coordinates.size() * sizeof(Vec2f) + corners.size() * sizeof(Triangle) +
                          image_of_face.size() * sizeof(uint16_t) + factors.size() * sizeof(Vec3f);
    for (const TextureImage& image : images) {
        size_bytes += sizeof image + image.name.size() + image.bytes.size();
    }
    return size_bytes;
}

void Texture::append(const Texture& other, size_t num_own, size_t num_other) {
    if (empty() && other.empty()) return;
    corners.resize(num_own, Triangle{});
    image_of_face.resize(num_own, 0);
    const size_t first = coordinates.size();
    PAIM_CHECK_LE(first + other.coordinates.size(), kMaxCoordinates);
    coordinates.insert(coordinates.end(), other.coordinates.begin(), other.coordinates.end());
    std::vector<uint16_t> numbers{0};  // of the other's images, here
    for (size_t i = 0; i < other.images.size(); ++i) {
        size_t same = 0;
        while (same < images.size() &&
               !(images[same] == other.images[i] && factors[same] == other.factors[i])) {
            ++same;
        }
        if (same == images.size()) {
            images.push_back(other.images[i]);
            factors.push_back(other.factors[i]);
        }
        numbers.push_back(static_cast<uint16_t>(same + 1));
    }
    PAIM_CHECK_LE(images.size(), kMaxImages);
    corners.resize(num_own + num_other, Triangle{});
    image_of_face.resize(num_own + num_other, 0);
    for (size_t f = 0; f < other.image_of_face.size(); ++f) {
        if (other.image_of_face[f] == 0) continue;
        image_of_face[num_own + f] = numbers[other.image_of_face[f]];
        for (size_t k = 0; k < 3; ++k) {
            corners[num_own + f][k] = other.corners[f][k] + static_cast<uint32_t>(first);
        }
    }
}

}  // namespace paim
