// Scenery from sections of a .paim.
#include "paim/format/paim/scenery_sections.h"

#include <algorithm>

#include "paim/format/container/mesh_sections.h"
#include "paim/format/paim/matrix_sections.h"

namespace paim {

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
