// Codec cpca in the search: how many clusters, how many components of each, and with which step.
#pragma once

#include <memory>

#include "compressor/encode/search/transfer_encoder.h"
#include "paim/codec/cpca/cpca_transfer.h"

namespace paim {

std::unique_ptr<TransferEncoder> make_cpca_encoder(const TransferSearchTask& task);

}  // namespace paim
