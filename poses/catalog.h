// The sequences that paim-poses knows by name.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "poses/sequence.h"

namespace paim::poses {

struct CatalogEntry {
    std::string_view name;
    std::string_view description;  // one line, for --help
    uint32_t min_vertices, max_vertices;
    bool colored;
    std::unique_ptr<Sequence> (*make)(uint32_t num_vertices);
};

std::span<const CatalogEntry> catalog();

// Finds a sequence. Error (usage), which lists the known names, if there is none of this name.
const CatalogEntry& find_sequence(std::string_view name);

}  // namespace paim::poses
