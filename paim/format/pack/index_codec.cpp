// Triangles as bytes: meshoptimizer's index codec under Zstandard.
#include "paim/format/pack/index_codec.h"

#include <meshoptimizer.h>

#include "paim/base/check.h"
#include "paim/format/pack/zstd_codec.h"

namespace paim {

std::vector<uint8_t> encode_triangles(const Topology& topology) {
    if (topology.triangles.empty()) return zstd_compress({});
    const auto* indices = reinterpret_cast<const uint32_t*>(topology.triangles.data());
    const size_t num_indices = 3 * topology.triangles.size();
    std::vector<uint8_t> encoded(
        meshopt_encodeIndexBufferBound(num_indices, topology.num_vertices));
    encoded.resize(meshopt_encodeIndexBuffer(encoded.data(), encoded.size(), indices, num_indices));
    PAIM_CHECK(!encoded.empty());
    return zstd_compress(encoded);
}

bool decode_triangles(std::span<const uint8_t> bytes, std::span<Triangle> out) {
    // The codec takes at most so many bytes a triangle, and some that do not depend on their number.
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
