// The codecs that files may have. codecs.cpp is the one place that names them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "paim/codec/transfer_model.h"

namespace paim {

struct TransferCodec {
    std::string_view name;
    // The metadata member that only files of this codec have. Empty: files without the marker of
    // any other codec have this codec.
    std::string_view marker;
    std::unique_ptr<TransferModel> (*make)();  // an empty model, which the reader fills
};

// All codecs: the built-in ones, then those that were added.
std::span<const TransferCodec> transfer_codecs();

// The codec of files without any marker. Its points are the vertices.
const TransferCodec& plain_codec();

// Transfer of that codec. Still parts use it, and so do files that are encoded without a search.
CodedTransfer plain_transfer(LowRank matrix);

// Adds a codec, so that its files can be read. No other codec has its name or marker (checked).
// Must be called before any other thread uses Paim. Invalidates what transfer_codecs() and
// plain_codec() returned.
// codec  whose name and marker live as long as the program
void add_transfer_codec(const TransferCodec& codec);

}  // namespace paim
