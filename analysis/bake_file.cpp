// Reads files that were made from a bake, or from the glossy transfer of one.
#include "analysis/bake_file.h"

#include "paim/base/error.h"
#include "paim/codec/gloss_asset.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/metadata.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/frame_error.h"

namespace paim {

namespace {

// Whether the file has glossy transfer alone.
bool is_glossy_alone(const std::filesystem::path& path) {
    const ContainerReader reader(path, section::kKindAnimation);
    const Metadata metadata(reader.read_text(reader.require(section::kMetadata, ScalarType::u8)),
                            reader.name());
    return metadata.root().contains("out_bands");
}

}  // namespace

Asset read_file_of(const BakeReader& bake, const std::filesystem::path& path) {
    if (bake.identity().layout.kind == TransferKind::diffuse) return read_paim(path);
    if (!std::filesystem::is_directory(path) && is_glossy_alone(path)) {
        ReadOptions options;
        options.kind = TransferKind::glossy;
        Asset asset = read_paim(path, options);
        set_frame_turns(bake, asset);
        return asset;
    }
    const Asset asset = read_paim(path);
    if (!asset.moving().gloss) throw_bad_input("{}: has no gloss", path.string());
    return gloss_asset(asset);
}

}  // namespace paim
