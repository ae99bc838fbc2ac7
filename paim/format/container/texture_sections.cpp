// Reads the texture of a mesh from sections.
#include "paim/format/container/texture_sections.h"

#include <algorithm>

#include "paim/base/error.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/mesh/lowest_corner.h"

namespace paim {

namespace {

// A section of any number of rows of `columns` values, or with any size if that is 0.
const Section& require_columns(const ContainerReader& reader, Tag tag, ScalarType type,
                               uint32_t columns, uint32_t index = 0) {
    const Section& section = reader.require(tag, type, index);
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || (columns > 0 ? shape[2] != columns : shape[1] != 1)) {
        throw_bad_input("{}: {} x {} x {} values, expected {} in a row", reader.label(section),
                        shape[0], shape[1], shape[2],
                        columns > 0 ? std::to_string(columns) : "all");
    }
    return section;
}

[[noreturn]] void throw_wrong_count(const ContainerReader& reader, const Section& section,
                                    size_t got, size_t expected) {
    throw_bad_input("{}: {} entries, expected {}", reader.label(section), got, expected);
}

// [count] pairs or triples of finite numbers.
template <typename Vector>
std::vector<Vector> read_vectors(const ContainerReader& reader, const Section& section) {
    const std::vector<float> values = reader.read_f32(section);
    check_finite(reader, section.spec.tag, values);
    constexpr auto kSize = static_cast<size_t>(Vector::SizeAtCompileTime);
    std::vector<Vector> vectors(values.size() / kSize);
    for (size_t i = 0; i < vectors.size(); ++i) {
        for (size_t k = 0; k < kSize; ++k) {
            vectors[i][static_cast<int>(k)] = values[kSize * i + k];
        }
    }
    return vectors;
}

void read_factors(const ContainerReader& reader, Tag tag, Texture& texture) {
    const Section& section = require_columns(reader, tag, ScalarType::f32, 3);
    const uint32_t count = section.spec.shape[1];
    if (count < 1 || count > kMaxImages) {
        throw_bad_input("{}: {} images, expected 1 to {}", reader.label(section), count,
                        kMaxImages);
    }
    texture.factors = read_vectors<Vec3f>(reader, section);
    for (const Vec3f& factor : texture.factors) {
        if (factor.minCoeff() >= 0.0f && factor.maxCoeff() <= 1.0f) continue;
        throw_bad_input("{}: factor {},{},{}, expected numbers from 0 to 1", reader.label(section),
                        factor.x(), factor.y(), factor.z());
    }
}

void read_images(const ContainerReader& reader, const section::TextureTags& tags,
                 Texture& texture) {
    const Section& section = require_columns(reader, tags.names, ScalarType::u8, 0);
    const std::string names = reader.read_text(section);
    const auto count = static_cast<size_t>(std::count(names.begin(), names.end(), '\0'));
    if (count != texture.factors.size() || names.back() != '\0') {
        throw_wrong_count(reader, section, count, texture.factors.size());
    }
    size_t begin = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const size_t end = names.find('\0', begin);
        const Section& image = require_columns(reader, tags.image, ScalarType::u8, 0, i);
        texture.images.push_back({names.substr(begin, end - begin), reader.read_u8(image)});
        begin = end + 1;
    }
}

void read_of_face(const ContainerReader& reader, Tag tag, size_t num_faces, Texture& texture) {
    const Section& section = require_columns(reader, tag, ScalarType::u32, 0);
    if (section.spec.shape[2] != num_faces) {
        throw_wrong_count(reader, section, section.spec.shape[2], num_faces);
    }
    for (const uint32_t image : reader.read_u32(section)) {
        if (image > texture.images.size()) {
            throw_bad_input("{}: image {} of a face, expected 0 to {}", reader.label(section),
                            image, texture.images.size());
        }
        texture.image_of_face.push_back(static_cast<uint16_t>(image));
    }
}

void read_corners(const ContainerReader& reader, Tag tag, const Topology& topology,
                  Texture& texture) {
    const Section& section = require_columns(reader, tag, ScalarType::u32, 3);
    const size_t num_faces = topology.triangles.size();
    if (section.spec.shape[1] != num_faces) {
        throw_wrong_count(reader, section, section.spec.shape[1], num_faces);
    }
    const std::vector<uint32_t> stored = reader.read_u32(section);
    texture.corners.resize(num_faces, Triangle{});
    uint32_t corner = 0;
    for (size_t f = 0; f < num_faces; ++f) {
        if (texture.image_of_face[f] == 0) continue;
        const size_t first = lowest_corner(topology.triangles[f]);
        for (size_t k = 0; k < 3; ++k) {
            corner = corner_after(corner, stored[3 * f + k]);
            if (corner >= texture.coordinates.size()) {
                throw_bad_input("{}: coordinate {} of triangle {}, expected 0 to {}",
                                reader.label(section), corner, f, texture.coordinates.size() - 1);
            }
            texture.corners[f][(first + k) % 3] = corner;
        }
    }
}

}  // namespace

std::vector<TextureSection> texture_sections(const Texture& texture,
                                             const section::TextureTags& tags) {
    if (texture.empty()) return {};
    const auto count = [](size_t size) { return static_cast<uint32_t>(size); };
    size_t name_bytes = 0;
    for (const TextureImage& image : texture.images) name_bytes += image.name.size() + 1;
    std::vector<TextureSection> sections{
        {TexturePiece::factors,
         {tags.factors, ScalarType::f32, 0, {1, count(texture.factors.size()), 3}}},
        {TexturePiece::names, {tags.names, ScalarType::u8, 0, {1, 1, count(name_bytes)}}},
        {TexturePiece::coordinates,
         {tags.coordinates, ScalarType::f32, 0, {1, count(texture.coordinates.size()), 2}}},
        {TexturePiece::of_face,
         {tags.of_face, ScalarType::u32, 0, {1, 1, count(texture.image_of_face.size())}}},
        {TexturePiece::corners,
         {tags.corners, ScalarType::u32, 0, {1, count(texture.corners.size()), 3}}}};
    for (uint32_t i = 0; i < texture.images.size(); ++i) {
        sections.push_back(
            {TexturePiece::image,
             {tags.image, ScalarType::u8, i, {1, 1, count(texture.images[i].bytes.size())}}});
    }
    return sections;
}

Texture read_texture(const ContainerReader& reader, const Topology& topology,
                     const section::TextureTags& tags) {
    const bool has_any =
        std::any_of(reader.sections().begin(), reader.sections().end(), [&](const Section& s) {
            const Tag all[] = {tags.names,   tags.image,   tags.coordinates,
                               tags.corners, tags.of_face, tags.factors};
            return std::find(std::begin(all), std::end(all), s.spec.tag) != std::end(all);
        });
    Texture texture;
    if (!has_any) return texture;
    read_factors(reader, tags.factors, texture);
    read_images(reader, tags, texture);
    texture.coordinates =
        read_vectors<Vec2f>(reader, require_columns(reader, tags.coordinates, ScalarType::f32, 2));
    if (texture.coordinates.empty()) {
        throw_bad_input("{}: 0 texture coordinates, expected at least 1", reader.name());
    }
    read_of_face(reader, tags.of_face, topology.triangles.size(), texture);
    read_corners(reader, tags.corners, topology, texture);
    return texture;
}

}  // namespace paim
