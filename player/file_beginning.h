// The beginning of a .paim that is still being written: how much there is, and what it plays.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/paim/prefixes.h"
#include "paim/mesh/bounds.h"

namespace paim::player {

// How much of a file is there.
struct LoadProgress {
    uint64_t size_bytes = 0;
    uint64_t whole_size_bytes = 0;  // 0: not known yet
    uint32_t components = 0;        // of geometry and transfer together, read
    uint32_t whole_components = 0;

    bool operator==(const LoadProgress&) const = default;
};

// "62 % of 1.2 MB, 9 of 23 components"; 100 % only of a whole file.
std::string progress_text(const LoadProgress& progress);

// What a look at a file finds.
struct Beginning {
    uint64_t size_bytes = 0;
    std::vector<Prefix> prefixes;     // empty: header and section table are not there yet
    std::vector<uint64_t> checksums;  // of the sections: another animation has others
    uint64_t inode = 0;               // another file has another

    uint64_t playable_bytes() const;  // the size of the longest prefix that is there, or 0
    LoadProgress progress() const;    // with no component read
};

// A file that is not there has no bytes. Errors as read_paim()'s, if header or table are damaged.
Beginning inspect_beginning(const std::filesystem::path& path);

struct LoadedAsset {
    std::shared_ptr<const Asset> asset;
    Bounds bounds;  // of the whole animation, with the components that are there
    LoadProgress progress;
    bool replaced = false;  // comes from another file than the model before
};

// What of the file can be played now, without its bounds. Errors as read_paim()'s.
LoadedAsset read_beginning(const std::filesystem::path& path, const Beginning& beginning);

// The same of what is there at this moment, with bounds.
LoadedAsset load_beginning(const std::filesystem::path& path);

}  // namespace paim::player
