// Decompresses Zstandard frames.
// Based on: Collet and Kucherawy, Zstandard Compression and the 'application/zstd' Media Type, RFC
//           8878
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace paim {

// The size of the contents as the frame states it; nothing if this is no frame, or states none.
std::optional<uint64_t> zstd_content_size(std::span<const uint8_t> frame);

// Fills `out`. Returns false if `frame` is not one whole frame, is damaged, or does not hold
// exactly out.size() bytes. Each thread keeps about 100 KiB of scratch memory.
bool zstd_decompress(std::span<const uint8_t> frame, std::span<uint8_t> out);

}  // namespace paim
