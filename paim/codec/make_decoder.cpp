// The decoder for a model, whatever its codec.
#include "paim/codec/make_decoder.h"

#include "paim/codec/cluster_decoder.h"
#include "paim/codec/svd_decoder.h"

namespace paim {

std::unique_ptr<Decoder> make_decoder(const Model& model) {
    if (model.clusters.empty()) return std::make_unique<SvdDecoder>(model);
    return std::make_unique<ClusterDecoder>(model);
}

}  // namespace paim
