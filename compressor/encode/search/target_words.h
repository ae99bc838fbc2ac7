// The words of each kind of transfer in messages about targets that cannot be met.
#pragma once

#include "paim/transfer/layout.h"

namespace paim {

struct TargetWords {
    const char* error;      // that is asked for: "a transfer error of 5 %"
    const char* bands;      // that leave out what light shows: "its 5 bands"
    const char* option;     // of the bake, for more bands
    const char* of_vertex;  // what the error of a vertex is of: "… of a vertex"
    const char* larger;     // what else to ask for
};

inline TargetWords target_words(const TransferLayout& layout) {
    if (layout.kind == TransferKind::glossy) {
        return {"gloss error", "bands of light", "--gloss-bands", "the gloss of one",
                "ask for a larger --max-gloss-error"};
    }
    return {"transfer error", "bands", "--bands", "one", "ask for a larger error"};
}

}  // namespace paim
