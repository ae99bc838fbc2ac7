// The codecs that files may have.
#include "paim/codec/codecs.h"

#include <algorithm>
#include <utility>
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
    static std::vector<TransferCodec> all{{SvdTransfer::kName, make<SvdTransfer>},
                                          {CpcaTransfer::kName, make<CpcaTransfer>, "clusters"}};
    return all;
}

}  // namespace

std::span<const TransferCodec> transfer_codecs() {
    return codecs();
}

const TransferCodec& plain_codec() {
    return codecs().front();
}

bool is_named_in_files(std::string_view codec) {
    return codec != plain_codec().name &&
           std::none_of(codecs().begin(), codecs().end(), [&](const TransferCodec& other) {
               return other.name == codec && !other.marker.empty();
           });
}

CodedTransfer plain_transfer(LowRank matrix) {
    std::unique_ptr<TransferModel> model = plain_codec().make();
    PAIM_CHECK(model->points_are_vertices());
    model->start(matrix.num_points);
    model->matrix = std::move(matrix);
    return model;
}

void add_transfer_codec(const TransferCodec& codec) {
    PAIM_CHECK(codec.marker.empty());
    for (const TransferCodec& other : codecs()) PAIM_CHECK(codec.name != other.name);
    codecs().push_back(codec);
}

}  // namespace paim
