// The faces of a part that has a texture. Vertices are decoded once, although a seam of the texture gives
// a vertex several places in an image: each pair of a vertex and a place is a corner to draw, which
// finds what was decoded by the number of its vertex.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "player/gl/data_texture.h"
#include "player/gl/program.h"
#include "player/render/image_textures.h"
#include "player/render/surface_mesh.h"

namespace paim::player {

class TexturedFaces {
  public:
    // mesh     with a texture (checked)
    // surface  of the mesh, with white radiance
    // images   those of the texture
    // Errors (unsupported): not enough memory, more vertices than a texture of this driver holds.
    TexturedFaces(const CodedMesh& mesh, const SurfaceMesh& surface,
                  std::shared_ptr<const ImageTextures> images);

    const std::shared_ptr<const ImageTextures>& images() const { return images_; }

    // Faces that follow the root motion, or those of a floor.
    enum class Place : size_t { following, floor };

    // Draws the faces without an image as SurfaceMesh::draw() does.
    void draw_plain(Place place) const;
    // Draws the others. The program is that of shader_source() and shaders/textured.frag, in use.
    void draw_images(Place place, const SurfaceMesh& surface, const gl::Program& program);

    static std::string shader_source();

    uint64_t texture_bytes() const;
    uint64_t buffer_bytes() const { return buffer_bytes_; }

  private:
    // Triangles [first, last) of an index buffer.
    struct Range {
        uint32_t image;
        size_t first, last;
    };
    void upload_corners(const CodedMesh& mesh);
    void upload_plain(const CodedMesh& mesh, const SurfaceMesh& surface);
    void copy_vertices(const SurfaceMesh& surface);

    std::shared_ptr<const ImageTextures> images_;
    gl::BufferHandle corners_, corner_indices_, plain_indices_;
    gl::VertexArrayHandle corner_array_, plain_array_;
    std::array<std::vector<Range>, 2> textured_;  // by Place
    std::array<Range, 2> plain_{};
    int width_log2_;
    gl::DataTexture positions_, white_radiances_;
    SurfaceMesh::Writes copied_;
    uint64_t buffer_bytes_ = 0;
};

}  // namespace paim::player
