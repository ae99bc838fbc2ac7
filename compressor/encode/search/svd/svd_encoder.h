// Codec svd in the search: how many components, and with which step.
#pragma once

#include <memory>

#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

TransferEncoderType svd_encoder_type();

}  // namespace paim
