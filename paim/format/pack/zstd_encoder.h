// Compresses into Zstandard frames.
// Based on: Collet and Kucherawy, Zstandard Compression and the 'application/zstd' Media Type, RFC
//           8878
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace paim {

// Effort of compression: `fast` while many candidates are compared, `small` for files.
enum class Effort { fast, small };

// Compresses into one frame that states the size of its contents. The same input gives the same
// bytes.
std::vector<uint8_t> zstd_compress(std::span<const uint8_t> bytes);

// The same for bytes that are nearly noise, where only frequencies of bytes help. Repetitions save
// little and take longest to decode, so they are used only if they save more than 3 %.
// effort      small: frames with and without repetitions are compared; fast: without
// block_ends  ascending offsets where the statistics of the bytes change: new tables start there
std::vector<uint8_t> zstd_compress_noise(std::span<const uint8_t> bytes,
                                         std::span<const size_t> block_ends, Effort effort);

// Memory to compress num_bytes bytes: tables, which grow with the bytes up to some size.
constexpr uint64_t zstd_compress_scratch_bytes(uint64_t num_bytes) {
    constexpr uint64_t kMaxTables = 92'000'000;
    const uint64_t tables = 4'000'000 + 17 * num_bytes;
    return tables < kMaxTables ? tables : kMaxTables;
}

}  // namespace paim
