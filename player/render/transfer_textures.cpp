// The codecs that the player draws.
#include "player/render/transfer_textures.h"

#include <algorithm>
#include <vector>

#include "paim/base/error.h"
#include "player/render/cpca/cpca_textures.h"
#include "player/render/svd/svd_textures.h"

namespace paim::player {

namespace {

std::span<const TransferUploader> uploaders() {
    static const std::vector<TransferUploader> all{svd_uploader(), cpca_uploader()};
    return all;
}

}  // namespace

std::span<const CodecWords> codec_words() {
    static const std::vector<CodecWords> all = [] {
        std::vector<CodecWords> words;
        for (const TransferUploader& uploader : uploaders()) {
            if (uploader.words) words.push_back(*uploader.words);
        }
        return words;
    }();
    return all;
}

const CodecWords* words_of_codec(std::string_view codec) {
    const auto found = std::find_if(codec_words().begin(), codec_words().end(),
                                    [&](const CodecWords& words) { return words.codec == codec; });
    return found == codec_words().end() ? nullptr : &*found;
}

const TransferUploader& find_uploader(const CodedMesh& mesh) {
    const auto found =
        std::find_if(uploaders().begin(), uploaders().end(), [&](const TransferUploader& uploader) {
            return uploader.codec == mesh.transfer->codec_name();
        });
    if (found == uploaders().end()) {
        throw_unsupported("transfer of codec '{}': this player does not draw it",
                          mesh.transfer->codec_name());
    }
    return *found;
}

}  // namespace paim::player
