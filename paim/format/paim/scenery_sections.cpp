// Scenery as sections of a .paim.
#include "paim/format/paim/scenery_sections.h"

#include <algorithm>
#include <span>

#include "paim/base/check.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/paim/matrix_sections.h"

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

Scenery read_scenery(const ContainerReader& reader, const TransferLayout& layout) {
    const Tag tags[] = {section::kSceneryTriangles, section::kSceneryPositions,
                        section::kSceneryAlbedo, section::kSceneryTransfer};
    Scenery scenery;
    if (std::none_of(std::begin(tags), std::end(tags),
                     [&](Tag tag) { return reader.find(tag) != nullptr; })) {
        return scenery;
    }
    const uint32_t num_vertices = count_vertices(reader, section::kSceneryPositions);
    scenery.topology = read_triangles(reader, num_vertices, section::kSceneryTriangles);
    const PlanePredictor predictor = read_predictor(reader, scenery.topology);
    scenery.positions =
        read_still_planes(reader, section::kSceneryPositions, section::kSceneryPositionSteps, 3,
                          num_vertices, predictor);
    scenery.albedo = read_albedo(reader, num_vertices, section::kSceneryAlbedo);
    scenery.transfer =
        read_still_planes(reader, section::kSceneryTransfer, section::kSceneryTransferSteps,
                          layout.num_planes(), num_vertices, predictor);
    return scenery;
}

}  // namespace paim
