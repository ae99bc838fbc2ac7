// A row of the table of sections that coded data consist of. A codec and a mesh list their rows
// once. Reading and writing a file both walk that list (format/paim/section_table.h).
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

// Integers of at least 0, stored in 16 bits.
struct SmallNumbers {
    std::vector<uint32_t>* values;
    uint32_t below;  // all values are below it; the reader refuses others
};

// One array of a file: its four-letter tag, its shape, and where its values are in memory.
struct SectionRow {
    std::string_view tag;
    uint32_t index = 0;  // number of the section among those with the same tag
    uint32_t num_rows = 0;
    uint32_t num_columns = 0;
    bool by_vertex = false;  // a column is a vertex; its integers are predicted from its neighbours
    std::variant<std::vector<float>*, StoredValues*, SmallNumbers> values;
};

// A number of the file's metadata that a codec's rows depend on.
struct NamedNumber {
    const char* name;
    uint32_t* value;
    uint32_t lowest, highest;  // the reader refuses numbers outside this range
    // The limit of playing that may reduce it, or nullptr.
    uint32_t DecodeLimits::*limit = nullptr;
};

}  // namespace paim
