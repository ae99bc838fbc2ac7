// The codecs that files may have. codecs.cpp is the one place that names them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "paim/codec/transfer_model.h"

namespace paim {

struct TransferCodec {
    std::string_view name;
    // The metadata member that only files of this codec have; empty: files without any of the others'.
    std::string_view marker;
    std::unique_ptr<TransferModel> (*make)();  // without values
};

// Built-in codecs first, then those that were added.
std::span<const TransferCodec> transfer_codecs();

// The codec of files without any marker. Its points are the vertices.
const TransferCodec& plain_codec();

// Transfer of that codec: of what stands still, and of whatever is coded without a search for a better
// codec.
CodedTransfer plain_transfer(LowRank matrix);

// Lets files of another codec be read from now on. Its name and marker are its own (checked). Not to be
// called while another thread reads files.
void add_transfer_codec(const TransferCodec& codec);

}  // namespace paim
