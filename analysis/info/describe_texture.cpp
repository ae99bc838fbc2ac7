// Describes the images on the faces of a mesh.
#include "analysis/info/describe_texture.h"

#include <algorithm>

#include "paim/base/error.h"
#include "paim/image/texture_image.h"

namespace paim {

void add_texture(const Texture& texture, nlohmann::ordered_json& json) {
    if (texture.empty()) return;
    const auto add_count = [&](const char* name, size_t count) {
        json[name] = json.value(name, size_t{0}) + count;
    };
    const auto& of_face = texture.image_of_face;
    add_count("num_textured_triangles",
              of_face.size() -
                  static_cast<size_t>(std::count(of_face.begin(), of_face.end(), uint16_t{0})));
    add_count("num_texture_coordinates", texture.coordinates.size());
    for (const TextureImage& image : texture.images) {
        nlohmann::ordered_json& entry = json["images"].emplace_back();
        entry["name"] = image.name;
        entry["size_bytes"] = image.bytes.size();
        try {
            const DecodedTexture decoded = decode_texture(image.bytes, image.name);
            entry["pixels"] = {decoded.width, decoded.height};
        } catch (const Error& error) {
            entry["damaged"] = error.what();
        }
    }
}

}  // namespace paim
