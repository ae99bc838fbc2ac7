// The codecs that a search tries.
#include "compressor/encode/search/cpca/cpca_encoder.h"
#include "compressor/encode/search/svd/svd_encoder.h"
#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

const std::vector<TransferEncoderType>& transfer_encoders() {
    static const std::vector<TransferEncoderType> types{
        {SvdTransfer::kName, true, make_svd_encoder},
        {CpcaTransfer::kName, false, make_cpca_encoder}};
    return types;
}

}  // namespace paim
