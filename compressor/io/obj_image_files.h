// The image files that map_Kd lines name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compressor/io/file_finder.h"
#include "compressor/io/obj_materials.h"
#include "paim/image/texture_image.h"

namespace paim {

// The most bytes of all images of a mesh together.
constexpr uint64_t kMaxImageBytes = uint64_t{1} << 30;

class ObjImageFiles {
  public:
    // warnings  must outlive this
    explicit ObjImageFiles(std::vector<std::string>& warnings) : warnings_(warnings) {}

    // The path of the image of a material that has one, found as material libraries are
    // (file_finder.h); nothing, with a warning, if it is not there.
    std::optional<std::filesystem::path> find(const ObjMaterial& material);

    // The bytes of the file; nothing, with a warning, if it cannot be read, is no image that
    // decode_texture() takes, or makes more than kMaxImageBytes with those before.
    // image  receives the decoded image
    std::optional<std::vector<uint8_t>> read(const std::filesystem::path& path,
                                             DecodedTexture& image);

  private:
    std::vector<std::string>& warnings_;
    std::map<std::filesystem::path, FileFinder> finders_;  // by folder
    uint64_t num_bytes_ = 0;
};

}  // namespace paim
