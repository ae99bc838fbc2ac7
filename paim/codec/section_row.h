// The table of sections that coded data consist of. A codec and a mesh list their rows once; reading
// and writing a file both walk that list (format/paim/section_table.h).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "paim/codec/decode_limits.h"
#include "paim/codec/low_rank.h"
#include "paim/mesh/topology.h"

namespace paim {

// Integers from 0 up, stored in 16 bits.
struct SmallNumbers {
    std::vector<uint32_t>* values;
    uint32_t below;  // every value is; anything else is an error when reading
};

// One array of a file: its four-letter tag, its shape, and where its values are in memory.
struct SectionRow {
    std::string_view tag;
    uint32_t index = 0;  // tells sections of one tag apart
    uint32_t num_rows = 0;
    uint32_t num_columns = 0;
    bool by_vertex = false;  // a column is a vertex: integers are predicted from its neighbours
    std::variant<std::vector<float>*, StoredValues*, SmallNumbers> values;
};

// A number of the file's metadata that a codec's rows depend on.
struct NamedNumber {
    const char* name;
    uint32_t* value;
    uint32_t lowest, highest;  // anything else is an error when reading
    // The limit of playing that may make it smaller, or none.
    uint32_t DecodeLimits::*limit = nullptr;
};

}  // namespace paim
