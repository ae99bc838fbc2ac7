// Vertex attributes and indices.
#include "player/render/surface_mesh.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/mesh/face_edges.h"
#include "player/gl/check.h"
#include "player/gl/index_range.h"

namespace paim::player {

namespace {

constexpr GLuint kPositionAttribute = 0,
                 kColorAttribute = 1;  // attributes, as in shaders/surface.vert

GLsizeiptr attribute_bytes(const Topology& topology) {
    // Buffers have room for one vertex at least: some drivers refuse empty ones.
    return static_cast<GLsizeiptr>(sizeof(Vec3f) * std::max(1u, topology.num_vertices));
}

void point_at(GLuint attribute, const gl::BufferHandle& buffer) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    glEnableVertexAttribArray(attribute);
}

// Replaces all of a buffer. The memory is new, so that no frame that is still drawn waits.
void replace(const gl::BufferHandle& buffer, const Topology& topology, const void* values,
             size_t num_bytes) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
    glBufferData(GL_ARRAY_BUFFER, attribute_bytes(topology), nullptr, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(num_bytes), values);
}

}  // namespace

SurfaceMesh::SurfaceMesh(const Topology& topology, bool has_white_radiance) : topology_(topology) {
    constexpr size_t kMostTriangles = std::numeric_limits<GLsizei>::max() / 6;  // 3 edges of 2 each
    if (topology.triangles.size() > kMostTriangles) {
        throw_unsupported("{} triangles, OpenGL draws at most {} at once",
                          topology.triangles.size(), kMostTriangles);
    }
    if (has_white_radiance) white_radiance_.emplace();
    std::vector<const gl::BufferHandle*> attributes = lit();
    attributes.push_back(&positions_);
    for (const gl::BufferHandle* buffer : attributes) {
        glBindBuffer(GL_ARRAY_BUFFER, buffer->id());
        glBufferData(GL_ARRAY_BUFFER, attribute_bytes(topology), nullptr, GL_STREAM_DRAW);
    }
    attach(edge_array_);
    attach(triangle_array_);
    gl::upload_indices(indices_, topology.triangles);
    gl::check_errors("uploading the triangles");
}

SurfaceMesh::SurfaceMesh(const CodedMesh& mesh)
    : SurfaceMesh(mesh.topology, !mesh.texture.empty()) {
    if (mesh.gloss) gloss_.emplace(mesh);
}

void SurfaceMesh::attach(const gl::VertexArrayHandle& array) const {
    glBindVertexArray(array.id());
    point_at(kPositionAttribute, positions_);
    point_at(kColorAttribute, colors_);
}

void SurfaceMesh::upload_positions(std::span<const float> planes) {
    const size_t num_vertices = topology_.num_vertices;
    PAIM_CHECK_EQ(planes.size(), 3 * num_vertices);
    scratch_.resize(planes.size());
    for (size_t v = 0; v < num_vertices; ++v) {
        for (size_t axis = 0; axis < 3; ++axis) {
            scratch_[3 * v + axis] = planes[axis * num_vertices + v];
        }
    }
    replace(positions_, topology_, scratch_.data(), scratch_.size() * sizeof(float));
}

void SurfaceMesh::upload_colors(std::span<const Vec3f> colors) {
    PAIM_CHECK_EQ(colors.size(), size_t{topology_.num_vertices});
    replace(colors_, topology_, colors.data(), colors.size_bytes());
}

void SurfaceMesh::upload_white_radiance(std::span<const Vec3f> radiance) {
    PAIM_CHECK_EQ(radiance.size(), size_t{topology_.num_vertices});
    replace(*white_radiance_, topology_, radiance.data(), radiance.size_bytes());
}

std::vector<const gl::BufferHandle*> SurfaceMesh::lit() const {
    if (!white_radiance_) return {&colors_};
    return {&colors_, &*white_radiance_};
}

void SurfaceMesh::draw(size_t first, size_t last) const {
    gl::draw_range(triangle_array_, GL_TRIANGLES, 3, first, last);
}

void SurfaceMesh::draw_edges(size_t first, size_t last) {
    if (first_edge_.empty()) upload_edges();
    gl::draw_range(edge_array_, GL_LINES, 2, first_edge_[first], first_edge_[last]);
}

// An edge belongs to the first of its triangles.
void SurfaceMesh::upload_edges() {
    std::vector<FaceEdge> edges;
    for_each_edge(face_edges(topology_), {},
                  [&](std::span<const FaceEdge> same_ends) { edges.push_back(same_ends.front()); });
    std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) {
        return std::pair(a.face, a.vertices) < std::pair(b.face, b.vertices);
    });
    first_edge_.assign(topology_.triangles.size() + 1, 0);
    std::vector<std::array<uint32_t, 2>> ends;
    for (const FaceEdge& edge : edges) {
        ends.push_back(edge.vertices);
        ++first_edge_[edge.face + 1];
    }
    for (size_t t = 1; t < first_edge_.size(); ++t) first_edge_[t] += first_edge_[t - 1];
    glBindVertexArray(edge_array_.id());
    gl::upload_indices(edges_, ends);
    gl::check_errors("uploading the edges");
}

uint64_t SurfaceMesh::buffer_bytes() const {
    const size_t num_edges = first_edge_.empty() ? 0 : first_edge_.back();
    return (1 + lit().size()) * static_cast<uint64_t>(attribute_bytes(topology_)) +
           topology_.triangles.size() * sizeof(Triangle) + num_edges * 2 * sizeof(uint32_t);
}

}  // namespace paim::player
