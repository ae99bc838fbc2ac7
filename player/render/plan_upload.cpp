// Plans how a coded mesh is laid out in textures.
#include "player/render/plan_upload.h"

#include <algorithm>

#include "player/gl/data_texture.h"
#include "player/render/transfer_textures.h"

namespace paim::player {

UploadPlan plan_upload(const CodedMesh& mesh, const DecodeLimits& limits, int max_texture_size) {
    const TransferModel& transfer = *mesh.transfer;
    UploadPlan plan;
    plan.layout = mesh.layout.with_bands(limits.bands);
    plan.geometry_components = std::min(limits.geometry_components, mesh.positions.num_components);
    plan.transfer_components = std::min(limits.transfer_components, transfer.matrix.num_components);
    plan.vertex_components = std::min(limits.vertex_components, transfer.num_vertex_components());

    const int64_t geometry = geometry_texels(mesh, plan.geometry_components);
    require_fit("geometry", plan.geometry_components, geometry, max_texture_size);
    const int64_t largest =
        std::max({geometry, find_uploader(mesh).largest_texture(mesh, plan, max_texture_size),
                  int64_t{plan.geometry_components}, int64_t{mesh.topology.num_vertices}});
    plan.width_log2 = gl::fitting_width_log2(largest, max_texture_size);
    return plan;
}

}  // namespace paim::player
