// Bytes through Zstandard.
#include "paim/format/zstd_codec.h"

#include <zstd.h>

#include <memory>
#include <utility>

#include "paim/base/check.h"

namespace paim {

namespace {

struct FreeContext {
    void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

constexpr int kSmallLevel = 19;
// Lowest length of what is found to repeat, in bytes; 0: what the level has.
constexpr int kShortestInNumbers = 7;

std::vector<uint8_t> compress(std::span<const uint8_t> bytes, std::span<const size_t> block_ends,
                              int level, int shortest_match) {
    const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
    PAIM_CHECK(context != nullptr);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level);
    ZSTD_CCtx_setParameter(context.get(), ZSTD_c_minMatch, shortest_match);
    ZSTD_CCtx_setPledgedSrcSize(context.get(), bytes.size());
    // A flush adds a block header, and may end one block early.
    constexpr size_t kBytesPerFlush = 64;
    std::vector<uint8_t> out(ZSTD_compressBound(bytes.size()) +
                             kBytesPerFlush * (block_ends.size() + 1));
    ZSTD_outBuffer output{out.data(), out.size(), 0};
    size_t begin = 0;
    const auto feed = [&](size_t end, ZSTD_EndDirective directive) {
        ZSTD_inBuffer input{bytes.data() + begin, end - begin, 0};
        const size_t left = ZSTD_compressStream2(context.get(), &output, &input, directive);
        PAIM_CHECK_EQ(left, 0u);
        begin = end;
    };
    for (const size_t end : block_ends) {
        if (end > begin && end < bytes.size()) feed(end, ZSTD_e_flush);
    }
    feed(bytes.size(), ZSTD_e_end);
    out.resize(output.pos);
    return out;
}

}  // namespace

std::vector<uint8_t> zstd_compress(std::span<const uint8_t> bytes) {
    return compress(bytes, {}, kSmallLevel, 0);
}

std::vector<uint8_t> zstd_compress_numbers(std::span<const uint8_t> bytes,
                                           std::span<const size_t> block_ends, Effort effort) {
    const int level = effort == Effort::small ? kSmallLevel : 1;
    std::vector<uint8_t> best = compress(bytes, {}, level, kShortestInNumbers);
    const auto consider = [&](std::span<const size_t> ends, int shortest_match) {
        std::vector<uint8_t> other = compress(bytes, ends, level, shortest_match);
        if (other.size() < best.size()) best = std::move(other);
    };
    consider(block_ends, kShortestInNumbers);
    if (effort == Effort::small) {
        consider(block_ends, 0);
        consider({}, 0);
    }
    return best;
}

std::optional<uint64_t> zstd_content_size(std::span<const uint8_t> frame) {
    const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) return std::nullopt;
    return size;
}

bool zstd_decompress(std::span<const uint8_t> frame, std::span<uint8_t> out) {
    const size_t got = ZSTD_decompress(out.data(), out.size(), frame.data(), frame.size());
    return ZSTD_isError(got) == 0 && got == out.size();
}

}  // namespace paim
