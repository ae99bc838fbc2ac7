// Images on the faces of a mesh.
#include "compressor/io/obj_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "compressor/io/obj_image_files.h"
#include "compressor/io/obj_text.h"
#include "compressor/io/texture_average.h"
#include "compressor/io/texture_corners.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

// The colour that multiplies an image.
Vec3f factor_of(const ObjMaterial& material) {
    Vec3d kd = material.diffuse.value_or(Vec3d::Ones()).cwiseMax(0.0).cwiseMin(1.0);
    if (kd.isZero(0.0)) kd.setOnes();
    return (kd * material.diffuse_share).cast<float>();
}

// A file that faces have, and its faces.
struct ImageFile {
    std::filesystem::path path;
    std::vector<uint32_t> faces;  // ascending
    std::vector<uint8_t> bytes;   // empty until it is read
};

class TextureReader {
  public:
    TextureReader(const std::string& name, const ObjScan& scan, const ObjLibraries& libraries,
                  const Topology& topology, std::span<const uint32_t> polygons,
                  std::vector<std::string>& warnings)
        : name_(name),
          scan_(scan),
          libraries_(libraries),
          topology_(topology),
          polygons_(polygons),
          warnings_(warnings),
          image_files_(warnings) {}

    Texture read(std::span<Vec3d> colours) {
        texture_.corners.resize(topology_.triangles.size(), Triangle{});
        texture_.image_of_face.resize(topology_.triangles.size(), 0);
        find_files();
        for (ImageFile& file : files_) read_file(file, colours);
        std::erase_if(files_, [](const ImageFile& file) { return file.bytes.empty(); });
        if (files_.empty()) return {};
        number_images();
        number_coordinates();
        return std::move(texture_);
    }

  private:
    const ObjMaterial* material_of(size_t face) const {
        return material_of_name(libraries_, scan_.face_materials[polygons_[face]]);
    }
    const ObjTextureMap& map_of(size_t face) const { return *material_of(face)->map; }

    // Puts each face that has coordinates and whose material has an image to its file; its corners
    // are coordinates of the scan from then on.
    void find_files() {
        std::map<const ObjMaterial*, std::optional<size_t>> of_material;
        std::map<std::filesystem::path, size_t> of_path;
        CornerFinder finder(scan_.faces);
        uint64_t num_bare = 0;
        for (uint32_t f = 0; f < topology_.triangles.size(); ++f) {
            const ObjMaterial* const material = material_of(f);
            if (material == nullptr || !material->map || material->map->file.empty()) continue;
            const auto [known, is_new] = of_material.try_emplace(material);
            if (is_new) known->second = number_of_file(*material, of_path);
            if (!known->second) continue;
            if (set_corners(f, finder)) {
                files_[*known->second].faces.push_back(f);
            } else {
                ++num_bare;
            }
        }
        if (num_bare > 0) {
            warnings_.push_back(
                fmt::format("{}: {} triangles have no texture coordinates (vt) for "
                            "the image of their material: Kd takes its place",
                            name_, num_bare));
        }
    }

    // The number of the file of a material; nothing if it is not there.
    std::optional<size_t> number_of_file(const ObjMaterial& material,
                                         std::map<std::filesystem::path, size_t>& of_path) {
        if (!material.map->ignored.empty()) {
            warnings_.push_back(fmt::format(
                "{}: map_Kd of material '{}': option {} is not read (only -s and -o are, and "
                "images repeat)",
                name_, printable(material.name), material.map->ignored));
        }
        const auto path = image_files_.find(material);
        if (!path) return std::nullopt;
        const auto [known, is_new] = of_path.try_emplace(path->lexically_normal(), files_.size());
        if (is_new) files_.push_back({*path, {}, {}});
        return known->second;
    }

    // Returns false if a corner has no coordinate.
    bool set_corners(uint32_t face, CornerFinder& finder) {
        if (scan_.corner_coordinates.empty()) return false;
        Triangle corners = finder.find(polygons_[face], topology_.triangles[face]);
        for (uint32_t& corner : corners) {
            corner = scan_.corner_coordinates[corner];
            if (corner == kNoCoordinate) return false;
        }
        texture_.corners[face] = corners;
        return true;
    }

    // Reads the file, and gives its faces their colours. Leaves it without bytes if it is no image.
    void read_file(ImageFile& file, std::span<Vec3d> colours) {
        if (file.faces.empty()) return;
        DecodedTexture decoded;
        auto bytes = image_files_.read(file.path, decoded);
        if (!bytes) return;
        file.bytes = std::move(*bytes);
        const MipPyramid image(std::move(decoded));
        std::vector<TextureAverage> averages(file.faces.size());
        parallel_for(averages.size(), 256, [&](size_t first, size_t end) {
            for (size_t i = first; i < end; ++i)
                averages[i] = average_of(image, places(file.faces[i]));
        });
        set_colours(file, averages, colours);
    }

    // The coordinates of the corners of a face, as its material moves them.
    std::array<Vec2f, 3> places(uint32_t face) const {
        std::array<Vec2f, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            corners[k] = coordinate(texture_.corners[face][k], map_of(face));
        }
        return corners;
    }

    // The triangles of a polygon follow each other.
    void set_colours(const ImageFile& file, std::span<const TextureAverage> averages,
                     std::span<Vec3d> colours) const {
        for (size_t i = 0; i < averages.size();) {
            const uint32_t polygon = polygons_[file.faces[i]];
            size_t end = i;
            TextureAverage sum, plain;
            for (; end < averages.size() && polygons_[file.faces[end]] == polygon; ++end) {
                sum.color += averages[end].area * averages[end].color;
                sum.area += averages[end].area;
                plain.color += averages[end].color;
            }
            const Vec3d mean = sum.area > 0.0 ? Vec3d(sum.color / sum.area)
                                              : Vec3d(plain.color / static_cast<double>(end - i));
            colours[polygon] =
                mean.cwiseProduct(factor_of(*material_of(file.faces[i])).cast<double>());
            i = end;
        }
    }

    // One image for each pair of a file and a factor.
    void number_images() {
        uint64_t num_bytes = 0;
        for (ImageFile& file : files_) {
            std::map<std::array<float, 3>, uint16_t> of_factor;
            for (const uint32_t face : file.faces) {
                const Vec3f factor = factor_of(*material_of(face));
                const auto [known, is_new] =
                    of_factor.try_emplace({factor.x(), factor.y(), factor.z()},
                                          static_cast<uint16_t>(texture_.images.size() + 1));
                texture_.image_of_face[face] = known->second;
                if (!is_new) continue;
                num_bytes += file.bytes.size();
                if (texture_.images.size() >= kMaxImages || num_bytes > kMaxImageBytes) {
                    throw_unsupported(
                        "{}: {} images of {} bytes, expected at most {} of {} (one for each file "
                        "and Kd): use fewer, or --no-textures",
                        name_, texture_.images.size() + 1, num_bytes, kMaxImages, kMaxImageBytes);
                }
                texture_.images.push_back({file.path.filename().string(), file.bytes});
                texture_.factors.push_back(factor);
            }
            file.bytes = {};
        }
    }

    // Keeps the coordinates that faces use, in the order in which they use them.
    void number_coordinates() {
        std::map<std::array<float, 4>, uint64_t> numbers_of_maps;
        std::unordered_map<uint64_t, uint32_t> numbers;
        for (size_t f = 0; f < topology_.triangles.size(); ++f) {
            if (texture_.image_of_face[f] == 0) {
                texture_.corners[f] = {};
                continue;
            }
            const ObjTextureMap& map = map_of(f);
            const std::array<float, 4> movement{map.scale.x(), map.scale.y(), map.offset.x(),
                                                map.offset.y()};
            const uint64_t of_map =
                numbers_of_maps.try_emplace(movement, numbers_of_maps.size()).first->second;
            for (uint32_t& corner : texture_.corners[f]) {
                const auto [known, is_new] = numbers.try_emplace(
                    (of_map << 32) | corner, static_cast<uint32_t>(texture_.coordinates.size()));
                if (is_new) texture_.coordinates.push_back(coordinate(corner, map));
                corner = known->second;
            }
        }
    }

    Vec2f coordinate(uint32_t vt, const ObjTextureMap& map) const {
        const Vec2f moved = scan_.coordinates[vt].cwiseProduct(map.scale) + map.offset;
        return moved.allFinite() ? moved : Vec2f(Vec2f::Zero());
    }

    const std::string& name_;
    const ObjScan& scan_;
    const ObjLibraries& libraries_;
    const Topology& topology_;
    std::span<const uint32_t> polygons_;
    std::vector<std::string>& warnings_;
    ObjImageFiles image_files_;
    std::vector<ImageFile> files_;
    Texture texture_;
};

}  // namespace

Texture read_texture(const std::string& name, const ObjScan& scan, const ObjLibraries& libraries,
                     const Topology& topology, std::span<const uint32_t> polygons,
                     std::span<Vec3d> colours, std::vector<std::string>& warnings) {
    PAIM_CHECK_EQ(colours.size(), scan.faces.num_faces());
    PAIM_CHECK_EQ(polygons.size(), topology.triangles.size());
    std::vector<std::string> own;
    Texture texture = TextureReader(name, scan, libraries, topology, polygons, own).read(colours);
    shorten_warnings(name, own);
    warnings.insert(warnings.end(), own.begin(), own.end());
    return texture;
}

}  // namespace paim
