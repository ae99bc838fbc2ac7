// Reads .paim files. Layout: docs/format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>

#include "paim/base/export.h"
#include "paim/codec/asset.h"

namespace paim {

struct ReadOptions {
    // Whether to read a prefix of a file, such as the part that has been loaded so far. The asset
    // then has the components that the prefix holds (Asset::complete, format/paim/prefixes.h).
    bool prefix = false;
    // Bytes to read at most: the source is taken to end there. Nothing is said of what comes after
    // them, not even where that is damaged.
    uint64_t most_bytes = std::numeric_limits<uint64_t>::max();
    // The kind of the transfer. Files of glossy transfer alone cannot be played: they are joined with
    // others (codec/gloss_asset.h).
    TransferKind kind = TransferKind::diffuse;
};

// Reads a .paim. Errors (bad input, unsupported) name the file and what is wrong. Indices, shapes
// and numbers are checked: all values of the asset are finite, and decode to finite values. A
// missing section is an error. A prefix may lack components; if it is too short to be played, the
// message says how many bytes are needed.
PAIM_EXPORT Asset read_paim(const std::filesystem::path& path, const ReadOptions& options = {});

// The same from memory, which is not kept.
// name  of the bytes in messages
PAIM_EXPORT Asset read_paim(std::span<const uint8_t> bytes, const std::string& name,
                            const ReadOptions& options = {});

}  // namespace paim
