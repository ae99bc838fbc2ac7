// What stands still, as a file has it, against the bake.
#include "paim/metrics/scenery_error.h"

#include "paim/base/check.h"
#include "paim/metrics/pose_space.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;

SceneryError measure_scenery(const Model& model, const BakeReader& bake,
                             const BandPower& spectrum) {
    PAIM_CHECK(bake.scenery().has_value());
    const BakedScenery& baked = *bake.scenery();
    const std::vector<uint32_t> old_vertex =
        match_vertices(model.scenery.topology, model.vertex_order, baked.topology,
                       bake.directory().string(), "triangles of the scenery");
    const auto in_order = [&](std::vector<float> planes) {
        reorder_planes(planes, old_vertex);
        return planes;
    };
    SceneryError error;
    error.geometry.add(model.scenery.positions.floats(), in_order(baked.pose.positions), 0);

    const TransferLayout& layout = bake.identity().layout;
    const auto num_vertices = static_cast<Index>(old_vertex.size());
    const std::vector<float> truth = in_order(baked.pose.transfer);
    const std::vector<float> noise = in_order(baked.pose.noise);
    const std::vector<float> decoded = model.scenery.transfer.floats();
    TransferErrorMeter meter(layout, baked.topology.num_vertices, 1, spectrum,
                             orthonormal_pose_space({}, 1));
    const auto values_of = [&](const std::vector<float>& planes, uint32_t plane) {
        return Eigen::Map<const MatrixXf>(planes.data() + plane * num_vertices, num_vertices, 1);
    };
    const std::vector<float> nothing(old_vertex.size());
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        const auto kept = plane_of_file(model.layout, layout, plane);
        meter.add(plane, values_of(truth, plane), values_of(noise, plane),
                  values_of(kept ? decoded : nothing, kept.value_or(0)));
    }
    error.transfer = meter.result();
    return error;
}

}  // namespace paim
