// One codec or the other.
#include "player/render/transfer_textures.h"

#include "player/render/cluster_transfer.h"
#include "player/render/vertex_transfer.h"

namespace paim::player {

std::unique_ptr<TransferTextures> make_transfer_textures(const Asset& model,
                                                         const UploadPlan& plan) {
    if (model.clusters.empty()) return std::make_unique<VertexTransfer>(model, plan);
    return std::make_unique<ClusterTransfer>(model, plan);
}

}  // namespace paim::player
