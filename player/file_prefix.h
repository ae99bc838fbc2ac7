// A prefix of a .paim that is still being written: its length, and the animation that it holds.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/paim/prefixes.h"
#include "paim/mesh/bounds.h"
#include "player/view/scene_units.h"

namespace paim::player {

// The part of a file that is there.
struct LoadProgress {
    uint64_t size_bytes = 0;
    uint64_t whole_size_bytes = 0;  // 0: not known yet
    uint32_t components = 0;        // of geometry and transfer together, read
    uint32_t whole_components = 0;

    bool operator==(const LoadProgress&) const = default;
};

// "62 % of 1.2 MB, 9 of 23 components"; 100 % only of a whole file.
std::string progress_text(const LoadProgress& progress);

// A prefix of a file, at the moment when it was looked at.
struct FilePrefix {
    uint64_t size_bytes = 0;
    // Those of the whole file that can be played; empty: header and section table are not there
    // yet.
    std::vector<Prefix> prefixes;
    std::vector<uint64_t> checksums;  // of the sections: another animation has others
    uint64_t inode = 0;               // another file has another

    uint64_t playable_bytes() const;  // the size of the longest prefix that is there, or 0
    // The same of those of at most so many bytes; if none of these has more than read_bytes, the
    // size of the next one that has.
    uint64_t playable_bytes(uint64_t read_bytes, uint64_t most_bytes) const;
    LoadProgress progress() const;  // with no component read
};

// A missing file has no bytes. Errors as read_paim()'s if header or table are damaged.
FilePrefix inspect_prefix(const std::filesystem::path& path);

struct LoadedAsset {
    std::shared_ptr<const Asset> asset;
    SceneUnits units;
    Bounds bounds;  // of the whole animation, with the components that are there
    LoadProgress progress;
    bool replaced = false;  // comes from another file than the asset before
};

// Reads what the first playable_bytes of the prefix hold, without bounds. Errors as read_paim()'s.
LoadedAsset read_prefix(const std::filesystem::path& path, const FilePrefix& prefix,
                        uint64_t playable_bytes);

// Bounds of an asset that was read so far. Those of a part of a file are of fewer poses, so that
// its first picture need not wait for them.
Bounds bounds_so_far(const Asset& asset);

// Reads the prefix that is there now, with bounds.
LoadedAsset load_prefix(const std::filesystem::path& path);

}  // namespace paim::player
