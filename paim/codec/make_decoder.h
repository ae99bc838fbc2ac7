// The decoder for a model, whatever its codec.
#pragma once

#include <memory>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim {

// Keeps a reference to the model.
std::unique_ptr<Decoder> make_decoder(const Model& model);

}  // namespace paim
