// Makes a .paim say how far it is from its bake.
#include "compressor/encode/state_errors.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "paim/base/error.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

namespace paim {

uint64_t measuring_memory_bytes(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                                uint64_t scenery_bytes) {
    // Half floats are floats in memory, and what is read is in memory beside what is made of it. Of
    // a plane: the bake, its noise, what was decoded, and as much while it is decoded; measuring takes
    // doubles, a few rows at a time.
    const uint64_t plane_bytes = sizeof(float) * num_vertices * num_poses;
    // Scenery: as baked, in the file's order, and as decoded.
    return std::max(3 * file_bytes, kProgramBytes + 2 * file_bytes) + 6 * plane_bytes +
           3 * scenery_bytes;
}

void check_measuring_memory(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                            uint64_t scenery_bytes, uint64_t limit_bytes, const std::string& what) {
    const uint64_t needed =
        measuring_memory_bytes(file_bytes, num_vertices, num_poses, scenery_bytes);
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
    TransferLayout kept = layout;
    kept = layout.with_bands(options.bands);
    const uint64_t value = options.precision == Precision::f16 ? 2 : 4;
    const uint64_t of_vertex = 3 * (4 + value * counted(options.geometry, 0)) +
                               kept.num_planes() * (4 + value * counted(options.transfer, most));
    check_measuring_memory(bake.num_vertices * of_vertex + bake.scenery_bytes / 2,
                           bake.num_vertices, bake.num_poses, bake.scenery_bytes,
                           options.memory_bytes, what);
}

AssetError state_errors(const std::filesystem::path& file, const BakeReader& bake,
                        const BandPower& spectrum, uint64_t memory_bytes) {
    check_measuring_memory(std::filesystem::file_size(file), bake.identity().num_vertices,
                           bake.num_poses(), bake_size(bake).scenery_bytes, memory_bytes,
                           file.string());
    Asset asset = read_paim(file);
    const AssetError error = measure_asset(asset, bake, spectrum);
    auto provenance = nlohmann::ordered_json::parse(asset.provenance_json);
    provenance["measured"] = nlohmann::ordered_json::parse(error_statement_json(error, spectrum));
    asset.provenance_json = provenance.dump();
    write_paim(file, asset);
    return error;
}

}  // namespace paim
