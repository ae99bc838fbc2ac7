// Decompresses Zstandard frames.
#include "paim/format/pack/zstd_decoder.h"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>

#include "paim/base/check.h"

namespace paim {

namespace {

struct FreeContext {
    void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

}  // namespace

std::optional<uint64_t> zstd_content_size(std::span<const uint8_t> frame) {
    const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) return std::nullopt;
    return size;
}

bool zstd_decompress(std::span<const uint8_t> frame, std::span<uint8_t> out) {
    // The library would also accept several frames, and skippable frames.
    constexpr std::array<uint8_t, 4> kMagic{0x28, 0xb5, 0x2f, 0xfd};
    if (frame.size() < kMagic.size() || !std::equal(kMagic.begin(), kMagic.end(), frame.begin()) ||
        ZSTD_findFrameCompressedSize(frame.data(), frame.size()) != frame.size()) {
        return false;
    }
    // Contexts are reused, because a new one queries the processor. On virtual machines that takes
    // tens of microseconds, longer than most sections.
    thread_local const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
    PAIM_CHECK(context != nullptr);
    const size_t got =
        ZSTD_decompressDCtx(context.get(), out.data(), out.size(), frame.data(), frame.size());
    return ZSTD_isError(got) == 0 && got == out.size();
}

}  // namespace paim
