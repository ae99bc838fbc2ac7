// Bytes out of Zstandard frames.
// Based on: Collet and Kucherawy, Zstandard Compression and the 'application/zstd' Media Type, RFC 8878
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace paim {

// The size that the frame says its contents have; nothing if this is no frame or does not say.
std::optional<uint64_t> zstd_content_size(std::span<const uint8_t> frame);

// Fills `out` exactly; false if this is not one whole frame, is damaged or holds anything but
// out.size() bytes. Threads keep what they work in, about 100 KiB.
bool zstd_decompress(std::span<const uint8_t> frame, std::span<uint8_t> out);

}  // namespace paim
