// The codecs that files may have. codecs.cpp is the one place that names them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "paim/codec/transfer_model.h"

namespace paim {

struct TransferCodec {
    std::string_view name;                     // in the metadata member `codec` of its files
    std::unique_ptr<TransferModel> (*make)();  // an empty model, which the reader fills
    // Only of a codec that is older than the member `codec`: another member that only its files
    // have.
    std::string_view marker = {};
};

// All codecs: the built-in ones, then those that were added.
std::span<const TransferCodec> transfer_codecs();

// The codec of files whose metadata say nothing about the codec. Its points are the vertices.
const TransferCodec& plain_codec();

// Whether files of this codec say its name. Those of codecs that are older than the member do not.
bool is_named_in_files(std::string_view codec);

// Transfer of that codec. Still parts use it, and so do files that are encoded without a search.
CodedTransfer plain_transfer(LowRank matrix);

// Adds a codec, so that its files can be read. No other codec has its name, and it has no marker
// (checked).
// Must be called before any other thread uses Paim. Invalidates what transfer_codecs() and
// plain_codec() returned.
// codec  whose name lives as long as the program
void add_transfer_codec(const TransferCodec& codec);

}  // namespace paim
