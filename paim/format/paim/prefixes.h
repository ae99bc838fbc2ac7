// Prefixes of a .paim that can be played: their sizes and their components.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "paim/format/container/container_reader.h"

namespace paim {

struct Prefix {
    uint64_t size_bytes = 0;  // from the start of the file
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    uint32_t gloss_components = 0;

    bool operator==(const Prefix&) const = default;
};

// Lists prefixes by the section table. The first is the shortest one that can be played, which has
// all sections but components. Each component that needs more bytes adds a prefix. A prefix has a
// component if it also has all earlier ones of the same attribute.
std::vector<Prefix> list_prefixes(const ContainerReader& reader);

// The same for a file that needs to have its header and section table only. Errors: bad input,
// naming the file, if these are missing or damaged; unsupported.
std::vector<Prefix> read_prefixes(const std::filesystem::path& path);

}  // namespace paim
