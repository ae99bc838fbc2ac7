// The bytes of the sections of a texture.
#include "paim/format/container/texture_section_writer.h"

#include <span>

#include "paim/base/check.h"
#include "paim/mesh/lowest_corner.h"

namespace paim {

namespace {

template <typename T>
std::vector<uint8_t> bytes_of(const std::vector<T>& values) {
    const auto* const first = reinterpret_cast<const uint8_t*>(values.data());
    return {first, first + values.size() * sizeof(T)};
}

std::vector<uint8_t> name_bytes(const Texture& texture) {
    std::vector<uint8_t> bytes;
    for (const TextureImage& image : texture.images) {
        // File names have no zero byte.
        bytes.insert(bytes.end(), image.name.begin(), image.name.end());
        bytes.push_back(0);
    }
    return bytes;
}

std::vector<uint8_t> corner_bytes(const Texture& texture, const Topology& topology) {
    std::vector<uint32_t> stored(3 * texture.corners.size(), 0);
    uint32_t before = 0;
    for (size_t f = 0; f < texture.corners.size(); ++f) {
        if (texture.image_of_face[f] == 0) continue;
        const size_t first = lowest_corner(topology.triangles[f]);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t corner = texture.corners[f][(first + k) % 3];
            stored[3 * f + k] = corner_difference(corner, before);
            before = corner;
        }
    }
    return bytes_of(stored);
}

}  // namespace

std::vector<uint8_t> texture_bytes(const Texture& texture, const Topology& topology,
                                   TexturePiece piece, uint32_t index) {
    PAIM_CHECK_EQ(texture.corners.size(), topology.triangles.size());
    PAIM_CHECK_EQ(texture.image_of_face.size(), topology.triangles.size());
    switch (piece) {
        case TexturePiece::names:
            return name_bytes(texture);
        case TexturePiece::image:
            return texture.images[index].bytes;
        case TexturePiece::coordinates:
            return bytes_of(texture.coordinates);
        case TexturePiece::corners:
            return corner_bytes(texture, topology);
        case TexturePiece::of_face:
            return bytes_of(
                std::vector<uint32_t>(texture.image_of_face.begin(), texture.image_of_face.end()));
        case TexturePiece::factors:
            return bytes_of(texture.factors);
    }
    return {};
}

}  // namespace paim
