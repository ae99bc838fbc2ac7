// What searches for several targets on one problem share.
#pragma once

#include <optional>

#include "compressor/encode/search/position_search.h"
#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

// Files do not depend on it: it holds what is a function of the problem and of what is asked for.
struct SearchMemo {
    SearchMemo(const EncodeProblem& problem, Precision precision) : positions(problem, precision) {}

    PositionFinder positions;
    // Of codecs, where there is a series of targets. One target has none, and takes the memory that
    // CodecMemory says.
    std::optional<CodecMemos> codecs;
};

}  // namespace paim
