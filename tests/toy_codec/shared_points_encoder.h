// The search's side of the third codec: every vertex is its own point.
#pragma once

#include "compressor/encode/search/transfer_encoder.h"

namespace paim::toy {

// What the codec says its search keeps, for tests of refusals.
constexpr uint64_t kKeptBytes = 300'000'000;

TransferEncoderType encoder_type();

}  // namespace paim::toy
