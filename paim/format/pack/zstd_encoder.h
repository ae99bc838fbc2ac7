// Bytes into Zstandard frames.
// Based on: Collet and Kucherawy, Zstandard Compression and the 'application/zstd' Media Type, RFC 8878
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace paim {

// How hard to look for a smaller result: fast while many candidates are compared, small for files.
enum class Effort { fast, small };

// One frame that states the size of its contents. The same bytes for the same input.
std::vector<uint8_t> zstd_compress(std::span<const uint8_t> bytes);

// The same of bytes that are nearly noise, so that only their frequencies help: repetitions gain
// little and take longest to undo, so that they are used only where they save more than 3 %.
// Small: frames with and without are compared. Fast: without.
// block_ends  offsets, ascending, where what follows has other statistics: new tables start there
std::vector<uint8_t> zstd_compress_noise(std::span<const uint8_t> bytes,
                                         std::span<const size_t> block_ends, Effort effort);

}  // namespace paim
