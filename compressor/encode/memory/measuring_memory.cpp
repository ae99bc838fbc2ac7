// How much memory it takes to measure a file after it was written.
#include "compressor/encode/memory/measuring_memory.h"

#include <algorithm>

#include "paim/base/error.h"
#include "paim/metrics/asset_error.h"

namespace paim {

uint64_t measuring_memory_bytes(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                                uint64_t still_mesh_bytes) {
    // Half floats become floats in memory, and the bytes that are read are in memory together with
    // the values that are made of them. Baked, noise and decoded values along the
    // directions that a decoder can follow take at most three planes, and their classes less than
    // one. The still mesh is there as baked, in the order of the file, and decoded.
    const uint64_t plane_bytes = sizeof(float) * num_vertices * num_poses;
    return std::max(3 * file_bytes, kProgramBytes + 2 * file_bytes) +
           (kPlanesMeasured + 4) * plane_bytes + 3 * still_mesh_bytes;
}

void check_measuring_memory(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                            uint64_t still_mesh_bytes, uint64_t limit_bytes,
                            const std::string& what) {
    const uint64_t needed =
        measuring_memory_bytes(file_bytes, num_vertices, num_poses, still_mesh_bytes);
    if (needed <= limit_bytes) return;
    throw_unsupported("{}: {} are needed to measure it, but --memory allows {}", what,
                      memory_text(needed), memory_text(limit_bytes - 1));
}

void check_measuring_memory(const EncodeSize& bake, const TransferLayout& layout,
                            const EncodeOptions& options, const std::string& what) {
    const uint64_t most = std::max<uint64_t>(1, bake.num_poses) - 1;
    const auto counted = [&](const ComponentChoice& choice, uint64_t of_all) {
        switch (choice.kind) {
            case ComponentChoice::Kind::number:
                return std::min<uint64_t>(choice.number, most);
            case ComponentChoice::Kind::all:
                return of_all;
            case ComponentChoice::Kind::automatic:
                break;
        }
        return uint64_t{0};
    };
    const TransferLayout kept = layout.with_bands(options.bands);
    const uint64_t value = options.precision == Precision::f16 ? 2 : 4;
    const uint64_t of_vertex = 3 * (4 + value * counted(options.geometry, 0)) +
                               kept.num_planes() * (4 + value * counted(options.transfer, most));
    check_measuring_memory(
        bake.num_vertices * of_vertex + bake.still_mesh_bytes / 2 + bake.texture_bytes,
        bake.num_vertices, bake.num_poses, bake.still_mesh_bytes + bake.texture_bytes,
        options.memory_bytes, what);
}

}  // namespace paim
