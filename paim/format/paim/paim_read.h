// Reads .paim files. Layout: docs/format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "paim/base/export.h"
#include "paim/codec/asset.h"

namespace paim {

struct ReadOptions {
    // Take a file of which only a prefix is there, as while it is being loaded: an asset with the
    // components that are there (Asset::complete, format/paim/prefixes.h).
    bool prefix = false;
};

// Errors (bad input, unsupported) name the file and what is wrong. Indices, shapes and numbers are
// checked: what is returned holds finite numbers and decodes to finite numbers. A section that is
// missing is an error; of a prefix, components may be missing, and the message says how many bytes a
// prefix needs to be playable.
PAIM_EXPORT Asset read_paim(const std::filesystem::path& path, const ReadOptions& options = {});

// The same from memory, which is not kept. name  what messages call the bytes
PAIM_EXPORT Asset read_paim(std::span<const uint8_t> bytes, const std::string& name,
                            const ReadOptions& options = {});

}  // namespace paim
