// The codecs that files may have.
#include "paim/codec/codecs.h"

#include <vector>

#include "paim/base/check.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim {

namespace {

template <typename Model>
std::unique_ptr<TransferModel> make() {
    return std::make_unique<Model>();
}

std::vector<TransferCodec>& codecs() {
    static std::vector<TransferCodec> all{{SvdTransfer::kName, "", make<SvdTransfer>},
                                          {CpcaTransfer::kName, "clusters", make<CpcaTransfer>}};
    return all;
}

}  // namespace

std::span<const TransferCodec> transfer_codecs() {
    return codecs();
}

void add_transfer_codec(const TransferCodec& codec) {
    PAIM_CHECK(!codec.marker.empty());
    for (const TransferCodec& other : codecs()) {
        PAIM_CHECK(codec.name != other.name && codec.marker != other.marker);
    }
    codecs().push_back(codec);
}

}  // namespace paim
