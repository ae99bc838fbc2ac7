// XXH3, the checksum of every Paim file.
// Based on: Yann Collet, xxHash, https://xxhash.com
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace paim {

// 64-bit XXH3 of the bytes. Detects damage, not tampering.
uint64_t xxh3(const void* data, size_t size_bytes);

// The same checksum of bytes that are given piece by piece.
class StreamingHash {
  public:
    StreamingHash();
    ~StreamingHash();
    StreamingHash(StreamingHash&&) noexcept;
    StreamingHash& operator=(StreamingHash&&) noexcept;
    void update(const void* data, size_t size_bytes);
    uint64_t digest() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace paim
