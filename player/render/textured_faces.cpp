// Corners, and copies of what was decoded.
#include "player/render/textured_faces.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "player/gl/check.h"
#include "player/gl/index_range.h"
#include "player/render/value_textures.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

// What shaders/textured.vert reads.
struct Corner {
    uint32_t vertex;
    Vec2f place;  // in the image, from its top
};

int width_log2_of(const Topology& topology) {
    const int width_log2 = gl::fitting_width_log2(topology.num_vertices, gl::max_texture_size());
    if (width_log2 < 0) {
        throw_unsupported("{} vertices with a texture, this driver's textures hold fewer",
                          topology.num_vertices);
    }
    return width_log2;
}

gl::DataTexture vertex_texture(const char* name, const Topology& topology, int width_log2) {
    return {name, gl::TexelFormat::rgb32f, width_log2, at_least_one(topology.num_vertices)};
}

// Which vertex and which coordinates: one number for each corner that differs from others.
uint64_t corner_key(uint32_t vertex, uint32_t coordinates) {
    return uint64_t{vertex} << 32 | coordinates;
}

}  // namespace

TexturedFaces::TexturedFaces(const CodedMesh& mesh, const SurfaceMesh& surface,
                             std::shared_ptr<const ImageTextures> images)
    : images_(std::move(images)),
      width_log2_(width_log2_of(mesh.topology)),
      positions_(vertex_texture("positions", mesh.topology, width_log2_)),
      white_radiances_(vertex_texture("white radiance", mesh.topology, width_log2_)) {
    PAIM_CHECK(!mesh.texture.empty() && surface.has_white_radiance());
    PAIM_CHECK_EQ(mesh.texture.image_of_face.size(), mesh.topology.triangles.size());
    upload_plain(mesh, surface);
    upload_corners(mesh);
    gl::check_errors("uploading faces with images");
}

void TexturedFaces::upload_plain(const CodedMesh& mesh, const SurfaceMesh& surface) {
    const size_t num_following = mesh.topology.num_triangles_before(mesh.num_following);
    std::vector<Triangle> plain;
    for (size_t f = 0; f < mesh.topology.triangles.size(); ++f) {
        if (f == num_following) plain_[0].last = plain_[1].first = plain.size();
        if (mesh.texture.image_of_face[f] == 0) plain.push_back(mesh.topology.triangles[f]);
    }
    if (num_following == mesh.topology.triangles.size()) {
        plain_[0].last = plain_[1].first = plain.size();
    }
    plain_[1].last = plain.size();
    surface.attach(plain_array_);
    gl::upload_indices(plain_indices_, plain);
    buffer_bytes_ += plain.size() * sizeof(Triangle);
}

// Faces in the order of their images, so that each image is drawn once.
void TexturedFaces::upload_corners(const CodedMesh& mesh) {
    const Texture& texture = mesh.texture;
    const size_t num_following = mesh.topology.num_triangles_before(mesh.num_following);
    std::vector<size_t> faces;
    std::vector<uint64_t> keys;
    for (size_t f = 0; f < mesh.topology.triangles.size(); ++f) {
        if (texture.image_of_face[f] == 0) continue;
        faces.push_back(f);
        for (size_t i = 0; i < 3; ++i) {
            keys.push_back(corner_key(mesh.topology.triangles[f][i], texture.corners[f][i]));
        }
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    std::vector<Corner> corners;
    for (const uint64_t key : keys) {
        const Vec2f& at = texture.coordinates[key & 0xffffffffu];
        corners.push_back({static_cast<uint32_t>(key >> 32), {at.x(), 1.0f - at.y()}});
    }
    const auto order = [&](size_t f) {
        return std::pair(f >= num_following, texture.image_of_face[f]);
    };
    std::stable_sort(faces.begin(), faces.end(),
                     [&](size_t a, size_t b) { return order(a) < order(b); });
    std::vector<Triangle> triangles;
    for (const size_t f : faces) {
        std::vector<Range>& ranges = textured_[order(f).first ? 1 : 0];
        const uint32_t image = texture.image_of_face[f] - 1u;
        if (ranges.empty() || ranges.back().image != image) {
            ranges.push_back({image, triangles.size(), 0});
        }
        Triangle& triangle = triangles.emplace_back();
        for (size_t i = 0; i < 3; ++i) {
            const uint64_t key = corner_key(mesh.topology.triangles[f][i], texture.corners[f][i]);
            triangle[i] = static_cast<uint32_t>(std::lower_bound(keys.begin(), keys.end(), key) -
                                                keys.begin());
        }
        ranges.back().last = triangles.size();
    }
    glBindVertexArray(corner_array_.id());
    gl::upload_indices(corner_indices_, triangles);
    glBindBuffer(GL_ARRAY_BUFFER, corners_.id());
    const size_t num_bytes = corners.size() * sizeof(Corner);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(num_bytes), corners.data(),
                 GL_STATIC_DRAW);
    glVertexAttribIPointer(0, 1, GL_UNSIGNED_INT, sizeof(Corner), nullptr);
    glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(Corner),
                          reinterpret_cast<const void*>(offsetof(Corner, place)));
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    buffer_bytes_ += triangles.size() * sizeof(Triangle) + num_bytes;
}

uint64_t TexturedFaces::texture_bytes() const {
    return images_->size_bytes() + positions_.size_bytes() + white_radiances_.size_bytes();
}

std::string TexturedFaces::shader_source() {
    return std::string(shaders::vertex_data_glsl) + std::string(shaders::textured_vert);
}

void TexturedFaces::draw_plain(Place place) const {
    const Range& range = plain_[static_cast<size_t>(place)];
    gl::draw_range(plain_array_, GL_TRIANGLES, 3, range.first, range.last);
}

void TexturedFaces::copy_vertices(const SurfaceMesh& surface) {
    const SurfaceMesh::Writes& writes = surface.writes();
    if (copied_.positions != writes.positions) positions_.copy(surface.positions());
    if (copied_.radiance != writes.radiance) white_radiances_.copy(surface.white_radiance());
    copied_ = writes;
}

void TexturedFaces::draw_images(Place place, const SurfaceMesh& surface,
                                const gl::Program& program) {
    const std::vector<Range>& ranges = textured_[static_cast<size_t>(place)];
    if (ranges.empty()) return;
    copy_vertices(surface);
    program.set_texture("positions", 0, positions_.handle());
    program.set_texture("white_radiances", 1, white_radiances_.handle());
    program.set("width_log2", width_log2_);
    for (const Range& range : ranges) {
        const ImageTextures::Image& image = images_->image(range.image);
        program.set_texture("image", 2, image.handle);
        program.set("num_levels", image.num_levels);
        program.set("factor", image.factor);
        gl::draw_range(corner_array_, GL_TRIANGLES, 3, range.first, range.last);
    }
}

}  // namespace paim::player
