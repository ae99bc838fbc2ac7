// Compresses into Zstandard frames.
#include "paim/format/pack/zstd_encoder.h"

// Declares the parameter that asks for Huffman codes in any case.
#define ZSTD_STATIC_LINKING_ONLY
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
// Shortest repetition that is searched for in noise, in bytes.
constexpr int kShortestInNoise = 7;
// Repetitions are used if they save more than 1 / kMinGain of the bytes.
constexpr size_t kMinGain = 32;

using CompressionContext = std::unique_ptr<ZSTD_CCtx, FreeContext>;

CompressionContext make_context() {
    CompressionContext context(ZSTD_createCCtx());
    PAIM_CHECK(context != nullptr);
    return context;
}

void set(const CompressionContext& context, ZSTD_cParameter parameter, int value) {
    PAIM_CHECK(ZSTD_isError(ZSTD_CCtx_setParameter(context.get(), parameter, value)) == 0);
}

CompressionContext with_repetitions(int shortest_match) {
    CompressionContext context = make_context();
    set(context, ZSTD_c_compressionLevel, kSmallLevel);
    set(context, ZSTD_c_minMatch, shortest_match);
    return context;
}

// Huffman codes alone: the search for repetitions steps over all bytes.
CompressionContext without_repetitions() {
    CompressionContext context = make_context();
    set(context, ZSTD_c_strategy, ZSTD_fast);
    set(context, ZSTD_c_minMatch, ZSTD_MINMATCH_MAX);
    set(context, ZSTD_c_targetLength, ZSTD_TARGETLENGTH_MAX);
    set(context, ZSTD_c_literalCompressionMode, ZSTD_lcm_huffman);
    return context;
}

std::vector<uint8_t> compress(std::span<const uint8_t> bytes, std::span<const size_t> block_ends,
                              const CompressionContext& context) {
    ZSTD_CCtx_setPledgedSrcSize(context.get(), bytes.size());
    // Bound of the bytes of a flush, which adds a block header and may end a block early.
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
    return compress(bytes, {}, with_repetitions(0));
}

std::vector<uint8_t> zstd_compress_noise(std::span<const uint8_t> bytes,
                                         std::span<const size_t> block_ends, Effort effort) {
    std::vector<uint8_t> best = compress(bytes, block_ends, without_repetitions());
    if (effort == Effort::fast) return best;
    size_t most = best.size() - best.size() / kMinGain;
    for (const int shortest_match : {kShortestInNoise, 0}) {
        std::vector<uint8_t> other = compress(bytes, block_ends, with_repetitions(shortest_match));
        if (other.size() >= most) continue;
        most = other.size();
        best = std::move(other);
    }
    return best;
}

}  // namespace paim
