// Scenery as sections of a .paim.
#include <span>

#include "paim/base/check.h"
#include "paim/format/container/mesh_section_writer.h"
#include "paim/format/paim/scenery_sections.h"

namespace paim {

std::vector<SectionSpec> scenery_specs(const Scenery& scenery, const TransferLayout& layout) {
    if (scenery.empty()) return {};
    const uint32_t num_vertices = scenery.topology.num_vertices;
    const auto planes = [&](Tag tag, uint32_t count) {
        return SectionSpec{tag, ScalarType::f32, 0, {1, count, num_vertices}};
    };
    return {triangles_spec(scenery.topology, section::kSceneryTriangles),
            planes(section::kSceneryPositions, 3),
            albedo_spec(scenery.albedo, section::kSceneryAlbedo),
            planes(section::kSceneryTransfer, layout.num_planes())};
}

void append_scenery(ContainerWriter& writer, size_t first, const Scenery& scenery) {
    if (scenery.empty()) return;
    const std::vector<float>& positions = scenery.positions.values.floats();
    PAIM_CHECK_EQ(positions.size(), size_t{3} * scenery.topology.num_vertices);
    append_mesh(writer, first, first + 2, scenery.topology, scenery.albedo);
    writer.append(first + 1, std::span(positions));
    writer.append(first + 3, std::span(scenery.transfer.values.floats()));
}

}  // namespace paim
