// Which vertices of a mesh reflect light in a glossy way, and how.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"

namespace paim {

// Glossy reflection, in addition to the diffuse one of the albedo.
struct GlossMaterial {
    // The BRDF of the brightest colour channel in words, such as "phong:0.5,32": what parse_brdf()
    // (compressor/material/brdfs.h) reads, and writes for the same BRDF.
    std::string brdf;
    // Reflected light is multiplied by it, 0..1 per channel; its largest channel is 1.
    Vec3f tint = Vec3f::Ones();

    bool operator==(const GlossMaterial&) const = default;
};

// The most glossy materials of a mesh.
constexpr size_t kMaxGlossMaterials = 65535;

struct Materials {
    std::vector<GlossMaterial> glossy;  // at most kMaxGlossMaterials
    // 0: the vertex is matte; m: it has glossy[m − 1]. [1], the same for all vertices, or [V].
    std::vector<uint16_t> of_vertex{0};

    bool empty() const { return glossy.empty(); }
    uint16_t at(uint32_t v) const { return of_vertex.size() == 1 ? of_vertex[0] : of_vertex[v]; }

    // Adds those of `num_other` vertices of the other after those of `num_own` vertices of this.
    // Materials that are equal are kept once.
    void append(const Materials& other, uint32_t num_own, uint32_t num_other);

    bool operator==(const Materials&) const = default;
};

// The vertices whose outgoing radiance is baked and stored, ascending: all of the faces that have a
// glossy vertex, so that radiance can be interpolated on every glossy face. A row of glossy transfer
// is one of them. If all vertices are glossy, they are all rows, with or without a face.
std::vector<uint32_t> glossy_rows(const Topology& topology, const Materials& materials);

// The tints of these vertices; those that are matte have white. [1] if all are the same, or [rows].
Albedo tints_of(const Materials& materials, std::span<const uint32_t> rows);

}  // namespace paim
