// Codec cpca in the search: how many clusters, how many components of each, and with which step.
#pragma once

#include <memory>

#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

TransferEncoderType cpca_encoder_type();

}  // namespace paim
