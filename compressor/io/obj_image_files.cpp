// The image files that map_Kd lines name.
#include "compressor/io/obj_image_files.h"

#include <fmt/format.h>

#include "compressor/io/obj_text.h"
#include "paim/base/error.h"
#include "paim/base/file.h"

namespace paim {

std::optional<std::filesystem::path> ObjImageFiles::find(const ObjMaterial& material) {
    const std::string& wanted = material.map->file;
    FileFinder& finder =
        finders_.try_emplace(material.folder, FileFinder(material.folder)).first->second;
    if (auto path = finder.find(wanted)) return path;
    if (auto found = finder.find_elsewhere(wanted)) {
        if (found->in_other_case) {
            warnings_.push_back(fmt::format("{}: taken for the image '{}'", found->path.string(),
                                            printable(wanted)));
        }
        return found->path;
    }
    warnings_.push_back(fmt::format("{}: image '{}' of material '{}' not found: Kd takes its place",
                                    material.folder.empty() ? "." : material.folder.string(),
                                    printable(wanted), printable(material.name)));
    return std::nullopt;
}

std::optional<std::vector<uint8_t>> ObjImageFiles::read(const std::filesystem::path& path,
                                                        DecodedTexture& image) {
    try {
        const std::vector<char> file = read_file(path, kMaxImageBytes - num_bytes_);
        const auto* const first = reinterpret_cast<const uint8_t*>(file.data());
        std::vector<uint8_t> bytes(first, first + file.size());
        image = decode_texture(bytes, path.string());
        num_bytes_ += bytes.size();
        return bytes;
    } catch (const Error& error) {
        warnings_.push_back(fmt::format("{}: Kd takes its place", error.what()));
        return std::nullopt;
    }
}

}  // namespace paim
