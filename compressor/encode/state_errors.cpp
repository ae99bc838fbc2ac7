// Measures a .paim against its bake and states the errors in it.
#include "compressor/encode/state_errors.h"

#include <nlohmann/json.hpp>

#include "compressor/encode/memory/measuring_memory.h"
#include "paim/base/json_text.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

namespace paim {

AssetError state_errors(const std::filesystem::path& file, const BakeReader& bake,
                        const BandPower& spectrum, uint64_t memory_bytes) {
    const EncodeSize size = bake_size(bake);
    check_measuring_memory(std::filesystem::file_size(file), bake.identity().num_vertices,
                           bake.num_poses(), size.still_mesh_bytes + size.texture_bytes,
                           memory_bytes, file.string());
    ReadOptions options;
    options.kind = bake.identity().layout.kind;
    Asset asset = read_paim(file, options);
    const AssetError error = measure_asset(asset, bake, spectrum);
    auto provenance = nlohmann::ordered_json::parse(asset.provenance_json);
    provenance["measured"] = nlohmann::ordered_json::parse(error_statement_json(error, spectrum));
    asset.provenance_json = json_text(provenance);
    write_paim(file, asset);
    return error;
}

}  // namespace paim
