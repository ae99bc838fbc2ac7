// Spheres in wrapping paper.
#include "tests/player/textured_asset.h"

#include <utility>

#include "tests/texture_bytes.h"

namespace paim::player {

TextureImage make_image(uint32_t width, uint32_t height,
                        const std::function<Rgb8(uint32_t x, uint32_t y)>& color) {
    std::vector<Rgb8> pixels;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) pixels.push_back(color(x, y));
    }
    return {"made.png", png_bytes(width, height, pixels)};
}

Texture wrap(const Topology& topology, uint32_t num_rings, float repeats,
             std::vector<TextureImage> images,
             const std::function<uint16_t(size_t face)>& image_of_face) {
    const uint32_t num_segments = 2 * num_rings;
    Texture texture;
    texture.images = std::move(images);
    texture.factors.assign(texture.images.size(), Vec3f::Ones());
    for (uint32_t ring = 0; ring <= num_rings; ++ring) {
        for (uint32_t s = 0; s <= num_segments; ++s) {
            texture.coordinates.emplace_back(
                repeats * static_cast<float>(s) / static_cast<float>(num_segments),
                repeats * (1.0f - static_cast<float>(ring) / static_cast<float>(num_rings)));
        }
    }
    for (size_t f = 0; f < topology.triangles.size(); ++f) {
        const auto quad = static_cast<uint32_t>(f / 2);
        Triangle& corners = texture.corners.emplace_back();
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t v = topology.triangles[f][i];
            const uint32_t ring = v / num_segments, s = v % num_segments;
            // The last quad of a ring ends where the first begins.
            const bool is_end = s == 0 && quad % num_segments == num_segments - 1;
            corners[i] = ring * (num_segments + 1) + (is_end ? num_segments : s);
        }
        texture.image_of_face.push_back(image_of_face(f));
    }
    return texture;
}

}  // namespace paim::player
