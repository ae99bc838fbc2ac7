// The still meshes of a bake, as one part of an asset.
#include "compressor/encode/data/still_part.h"

#include <vector>

#include "paim/base/check.h"
#include "paim/codec/codecs.h"

namespace paim {

std::optional<CodedMesh> still_part(const BakeReader& bake, uint32_t bands) {
    if (!bake.still_mesh()) return std::nullopt;
    const BakedStillMesh& baked = *bake.still_mesh();
    const TransferLayout& layout = bake.identity().layout;
    PAIM_CHECK_LE(bands, layout.in_bands);
    CodedMesh mesh;
    mesh.topology = baked.topology;
    mesh.albedo = baked.albedo;
    mesh.texture = baked.texture;
    mesh.layout = layout.with_bands(bands);
    mesh.positions = LowRank::still(3, baked.pose.positions);
    const size_t num_vertices = baked.topology.num_vertices;
    std::vector<uint32_t> planes;
    planes_of(layout, mesh.layout, planes);
    std::vector<float> transfer;
    for (const uint32_t plane : planes) {
        const auto first =
            baked.pose.transfer.begin() + static_cast<ptrdiff_t>(plane * num_vertices);
        transfer.insert(transfer.end(), first, first + static_cast<ptrdiff_t>(num_vertices));
    }
    mesh.transfer = plain_transfer(LowRank::still(mesh.layout.num_planes(), std::move(transfer)));
    return mesh;
}

}  // namespace paim
