// XXH3 checksums through xxHash, compiled in: programs that link the runtime need no library for
// them.
#include "paim/base/hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <new>

namespace paim {

struct StreamingHash::State {
    XXH3_state_t* xxh = XXH3_createState();
    State() {
        if (xxh == nullptr) throw std::bad_alloc();
        XXH3_64bits_reset(xxh);
    }
    ~State() { XXH3_freeState(xxh); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
};

uint64_t xxh3(const void* data, size_t size_bytes) {
    return XXH3_64bits(data, size_bytes);
}

StreamingHash::StreamingHash() : state_(std::make_unique<State>()) {}
StreamingHash::~StreamingHash() = default;
StreamingHash::StreamingHash(StreamingHash&&) noexcept = default;
StreamingHash& StreamingHash::operator=(StreamingHash&&) noexcept = default;

void StreamingHash::update(const void* data, size_t size_bytes) {
    XXH3_64bits_update(state_->xxh, data, size_bytes);
}

uint64_t StreamingHash::digest() const {
    return XXH3_64bits_digest(state_->xxh);
}

}  // namespace paim
