// The codecs that the player draws.
#include "player/render/transfer_textures.h"

#include <algorithm>
#include <array>

#include "paim/base/error.h"
#include "player/render/cpca/cpca_textures.h"
#include "player/render/svd/svd_textures.h"

namespace paim::player {

const TransferUploader& find_uploader(const CodedMesh& mesh) {
    static const std::array<TransferUploader, 2> uploaders{svd_uploader(), cpca_uploader()};
    const auto found =
        std::find_if(uploaders.begin(), uploaders.end(), [&](const TransferUploader& uploader) {
            return uploader.codec == mesh.transfer->codec_name();
        });
    if (found == uploaders.end()) {
        throw_unsupported("transfer of codec '{}': this player does not draw it",
                          mesh.transfer->codec_name());
    }
    return *found;
}

}  // namespace paim::player
