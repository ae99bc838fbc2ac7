// Decodes triangles: Zstandard, then meshoptimizer's index codec.
#include "paim/format/pack/index_decoder.h"

#include <meshoptimizer.h>

#include <vector>

#include "paim/format/pack/zstd_decoder.h"

namespace paim {

bool decode_triangles(std::span<const uint8_t> bytes, std::span<Triangle> out) {
    // The index codec needs at most 16 bytes a triangle, and a constant number of bytes.
    const uint64_t most = uint64_t{16} * out.size() + 64;
    const auto size = zstd_content_size(bytes);
    if (!size || *size > most) return false;
    std::vector<uint8_t> encoded(*size);
    if (!zstd_decompress(bytes, encoded)) return false;
    if (out.empty()) return encoded.empty();
    auto* indices = reinterpret_cast<uint32_t*>(out.data());
    return meshopt_decodeIndexBuffer(indices, 3 * out.size(), sizeof(uint32_t), encoded.data(),
                                     encoded.size()) == 0;
}

}  // namespace paim
