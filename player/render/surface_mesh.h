// The surface of a mesh as OpenGL draws it: a position and a colour for each vertex, and triangles; with
// a texture (render/textured_faces.h) also the radiance of a white surface.
// Where these come from is not its concern (render/vertex_source.h).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"
#include "player/gl/handle.h"
#include "player/render/surface_gloss.h"

namespace paim::player {

class SurfaceMesh {
  public:
    // Makes room for the vertices, whose positions and colours are undefined until something writes
    // them, and uploads the triangles. Keeps a reference to the topology. Errors (unsupported): more
    // triangles than OpenGL draws at once, or not enough memory.
    // has_white_radiance  makes room for it, too
    explicit SurfaceMesh(const Topology& topology, bool has_white_radiance = false);
    // The same for all that a coded mesh has: white radiance if it has a texture, and gloss.
    explicit SurfaceMesh(const CodedMesh& mesh);

    uint32_t num_vertices() const { return topology_.num_vertices; }

    // [V][3] 32-bit floats each: local positions in scene units, and linear RGB.
    const gl::BufferHandle& positions() const { return positions_; }
    const gl::BufferHandle& colors() const { return colors_; }
    bool has_white_radiance() const { return white_radiance_.has_value(); }
    const gl::BufferHandle& white_radiance() const { return *white_radiance_; }
    // nullptr if the surface has none.
    const SurfaceGloss* gloss() const { return gloss_ ? &*gloss_ : nullptr; }
    // What light changes of buffers: the colours, then the white radiance if there is one.
    std::vector<const gl::BufferHandle*> lit() const;

    // planes  [3][V]: all x, then all y, then all z
    void upload_positions(std::span<const float> planes);
    void upload_colors(std::span<const Vec3f> colors);
    void upload_white_radiance(std::span<const Vec3f> radiance);

    // How often positions, radiance and outgoing coefficients were written (VertexSource), so that
    // copies know when they are out of date.
    struct Writes {
        uint64_t positions = 0, radiance = 0, gloss = 0;
    };
    const Writes& writes() const { return writes_; }
    void count_writes(bool positions, bool radiance, bool gloss) {
        writes_.positions += positions ? 1 : 0;
        writes_.radiance += radiance ? 1 : 0;
        writes_.gloss += gloss ? 1 : 0;
    }

    // Binds a vertex array and makes positions and colours its attributes 0 and 1.
    void attach(const gl::VertexArrayHandle& array) const;

    // Draws triangles [first, last) with attribute 0, the position, and attribute 1, the colour.
    void draw(size_t first, size_t last) const;
    // Draws the edges of triangles [first, last) in the same way, each edge once.
    void draw_edges(size_t first, size_t last);

    // Of all attributes and indices.
    uint64_t buffer_bytes() const;

  private:
    void upload_edges();

    const Topology& topology_;
    gl::BufferHandle positions_, colors_, indices_, edges_;
    std::optional<gl::BufferHandle> white_radiance_;
    std::optional<SurfaceGloss> gloss_;
    Writes writes_;
    gl::VertexArrayHandle triangle_array_, edge_array_;
    std::vector<float> scratch_;
    // [T + 1] The first of the edges that triangle t and those after it bring; empty: edges have not
    // been uploaded.
    std::vector<uint32_t> first_edge_;
};

}  // namespace paim::player
