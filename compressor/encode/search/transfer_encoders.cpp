// The codecs that a search tries.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "compressor/encode/search/cpca/cpca_encoder.h"
#include "compressor/encode/search/svd/svd_encoder.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/codec/codecs.h"

namespace paim {

namespace {

std::vector<TransferEncoderType>& types() {
    static std::vector<TransferEncoderType> all{svd_encoder_type(), cpca_encoder_type()};
    return all;
}

bool is_any(std::string_view codec) {
    return codec.empty() || codec == "auto";
}

void check_codec(std::string_view codec) {
    if (is_any(codec)) return;
    std::string names = "auto";
    for (const TransferEncoderType& type : types()) {
        if (type.codec == codec) return;
        names += fmt::format(", {}", type.codec);
    }
    throw_usage("codec: expected one of {}, got '{}'", names, codec);
}

}  // namespace

const std::vector<TransferEncoderType>& transfer_encoders() {
    return types();
}

void add_transfer_encoder(TransferEncoderType type) {
    PAIM_CHECK(!is_any(type.codec));
    const auto codecs = transfer_codecs();
    PAIM_CHECK(std::any_of(codecs.begin(), codecs.end(),
                           [&](const TransferCodec& codec) { return codec.name == type.codec; }));
    for (const char* const word : {type.words.description, type.words.cost, type.words.missed}) {
        PAIM_CHECK(*word != '\0');
    }
    for (const TransferEncoderType& other : types()) PAIM_CHECK(type.codec != other.codec);
    types().push_back(std::move(type));
}

std::vector<const TransferEncoderType*> encoders_to_try(std::string_view codec,
                                                        Precision precision) {
    check_codec(codec);
    std::vector<const TransferEncoderType*> able;
    for (const TransferEncoderType& type : types()) {
        if (!is_any(codec) && type.codec != codec) continue;
        if (is_integer(precision) || type.codes_floats) able.push_back(&type);
    }
    if (able.empty()) {
        throw_usage("codec {}: codes integers alone: expected --precision auto, got floats", codec);
    }
    return able;
}

std::vector<SearchedCodec> searched_codecs(const std::vector<const TransferEncoderType*>& types) {
    std::vector<SearchedCodec> codecs;
    for (const TransferEncoderType* type : types) codecs.push_back({type->codec, type->memory});
    return codecs;
}

}  // namespace paim
