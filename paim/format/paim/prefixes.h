// Prefixes of a .paim that can be played: how many bytes they take and what they hold.
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

    bool operator==(const Prefix&) const = default;
};

// From the section table: first the shortest prefix that can be played, which has everything but
// components, then one for every component that it takes more bytes to have. A component counts once
// all those of its part before it are there.
std::vector<Prefix> list_prefixes(const ContainerReader& reader);

// The same of a file of which no more than header and section table need be there. Errors: bad
// input, naming the file, if they are not, or damaged; unsupported.
std::vector<Prefix> read_prefixes(const std::filesystem::path& path);

}  // namespace paim
