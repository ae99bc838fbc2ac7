// Encodes triangles: meshoptimizer's index codec, then Zstandard.
#include "paim/format/pack/index_encoder.h"

#include <meshoptimizer.h>

#include "paim/base/check.h"
#include "paim/format/pack/zstd_encoder.h"

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

}  // namespace paim
