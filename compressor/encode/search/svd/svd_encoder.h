// Codec svd in the search: how many components, and with which step.
#pragma once

#include <memory>

#include "compressor/encode/search/transfer_encoder.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim {

std::unique_ptr<TransferEncoder> make_svd_encoder(const TransferSearchTask& task);

}  // namespace paim
