// Which vertices of a mesh reflect light in a glossy way.
#include "paim/mesh/materials.h"

#include <algorithm>
#include <numeric>

#include "paim/base/check.h"

namespace paim {

namespace {

bool is_glossy(const Triangle& face, const Materials& materials) {
    return std::any_of(face.begin(), face.end(), [&](uint32_t v) { return materials.at(v) > 0; });
}

}  // namespace

void Materials::append(const Materials& other, uint32_t num_own, uint32_t num_other) {
    std::vector<uint16_t> numbers{0};  // of the other's materials, here
    for (const GlossMaterial& material : other.glossy) {
        const auto found = std::find(glossy.begin(), glossy.end(), material);
        const auto index = static_cast<size_t>(found - glossy.begin());
        if (found == glossy.end()) glossy.push_back(material);
        numbers.push_back(static_cast<uint16_t>(index + 1));
    }
    PAIM_CHECK_LE(glossy.size(), kMaxGlossMaterials);
    const bool is_uniform = of_vertex.size() == 1 && other.of_vertex.size() == 1;
    if (is_uniform && of_vertex[0] == numbers[other.of_vertex[0]]) return;
    if (of_vertex.size() == 1) of_vertex.assign(num_own, uint16_t{of_vertex[0]});
    for (uint32_t v = 0; v < num_other; ++v) of_vertex.push_back(numbers[other.at(v)]);
}

std::vector<uint32_t> glossy_rows(const Topology& topology, const Materials& materials) {
    const auto& numbers = materials.of_vertex;
    const bool all_glossy =
        std::all_of(numbers.begin(), numbers.end(), [](uint16_t m) { return m > 0; });
    std::vector<uint32_t> rows;
    if (all_glossy) {
        rows.resize(topology.num_vertices);
        std::iota(rows.begin(), rows.end(), 0u);
        return rows;
    }
    std::vector<uint8_t> is_row(topology.num_vertices, 0);
    for (const Triangle& face : topology.triangles) {
        if (!is_glossy(face, materials)) continue;
        for (const uint32_t v : face) is_row[v] = 1;
    }
    for (uint32_t v = 0; v < topology.num_vertices; ++v) {
        if (is_row[v]) rows.push_back(v);
    }
    return rows;
}

Albedo tints_of(const Materials& materials, std::span<const uint32_t> rows) {
    const auto tint = [&](uint32_t v) -> Vec3f {
        const uint16_t number = materials.at(v);
        return number == 0 ? Vec3f::Ones().eval() : materials.glossy[number - 1u].tint;
    };
    Albedo tints;
    tints.values.assign(1, Vec3f::Ones());
    if (rows.empty()) return tints;
    tints.values.clear();
    for (const uint32_t v : rows) tints.values.push_back(tint(v));
    const Vec3f first = tints.values[0];
    const bool alike = std::all_of(tints.values.begin(), tints.values.end(),
                                   [&](const Vec3f& value) { return value == first; });
    if (alike) tints.values.resize(1);
    return tints;
}

}  // namespace paim
