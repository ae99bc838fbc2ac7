// Codec cpca with a given number of clusters, for error curves over this number.
#pragma once

#include <cstdint>

#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

// As TransferEncoderType::code_groups: kUsualAssumedComponents components of a cluster, and the coarsest
// step that adds at most 1 % to the error that clusters and components leave, or a ten-thousandth of the
// transfer if they leave next to nothing.
// num_clusters  at least 1; with more than most_clusters() of the vertices, these
CodedTransfer code_clusters(const TransferSearchTask& task, uint32_t num_clusters);

}  // namespace paim
