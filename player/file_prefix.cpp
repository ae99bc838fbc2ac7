// Inspecting and reading the prefix of a file that is there.
#include "player/file_prefix.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "paim/base/hash.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "player/read_asset.h"

namespace paim::player {

namespace {

using container::Header;
using container::TableEntry;

// Bytes of header and section table; 0 if the header is not a valid one.
uint64_t table_end(const std::filesystem::path& path) {
    Header header;
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(&header), sizeof(header));
    const auto got = static_cast<size_t>(file.gcount());
    const size_t num_known = std::min(got, header.magic.size());
    if (!std::equal(container::kMagic.begin(),
                    container::kMagic.begin() + static_cast<ptrdiff_t>(num_known),
                    header.magic.begin())) {
        return 0;
    }
    if (got < sizeof(header)) return sizeof(header);
    if (header.header_xxh3 != xxh3(&header, sizeof(header) - sizeof(header.header_xxh3))) return 0;
    const uint64_t end = sizeof(header) + uint64_t{header.num_sections} * sizeof(TableEntry);
    return end <= header.file_size_bytes ? end : 0;
}

uint32_t num_components(const CodedMesh& mesh) {
    return mesh.positions.num_components + mesh.transfer->matrix.num_components;
}

std::string size_text(uint64_t size_bytes) {
    const auto size = static_cast<double>(size_bytes);
    return size_bytes < 1000000 ? fmt::format("{:.0f} kB", 1e-3 * size)
                                : fmt::format("{:.1f} MB", 1e-6 * size);
}

}  // namespace

std::string progress_text(const LoadProgress& progress) {
    if (progress.whole_size_bytes == 0) return size_text(progress.size_bytes);
    const double share =
        static_cast<double>(progress.size_bytes) / static_cast<double>(progress.whole_size_bytes);
    return fmt::format("{} % of {}, {} of {} components", static_cast<int>(100.0 * share),
                       size_text(progress.whole_size_bytes), progress.components,
                       progress.whole_components);
}

uint64_t FilePrefix::playable_bytes() const {
    return playable_bytes(0, size_bytes);
}

uint64_t FilePrefix::playable_bytes(uint64_t read_bytes, uint64_t most_bytes) const {
    uint64_t playable = 0;
    for (const Prefix& prefix : prefixes) {
        if (prefix.size_bytes > size_bytes) break;
        if (prefix.size_bytes <= most_bytes || playable <= read_bytes) playable = prefix.size_bytes;
    }
    return playable;
}

LoadProgress FilePrefix::progress() const {
    LoadProgress progress{size_bytes, 0, 0, 0};
    if (!prefixes.empty()) {
        const Prefix& whole = prefixes.back();
        progress.whole_size_bytes = whole.size_bytes;
        progress.size_bytes = std::min(size_bytes, whole.size_bytes);
        progress.whole_components = whole.geometry_components + whole.transfer_components;
    }
    return progress;
}

FilePrefix inspect_prefix(const std::filesystem::path& path) {
    FilePrefix prefix;
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0 && errno == ENOENT) return prefix;
    prefix.inode = info.st_ino;
    if (S_ISREG(info.st_mode)) {
        prefix.size_bytes = static_cast<uint64_t>(info.st_size);
        if (prefix.size_bytes < table_end(path)) return prefix;
    }
    const ContainerReader reader(path, section::kKindAnimation, Extent::prefix);
    prefix.size_bytes = reader.file_size_bytes();
    prefix.prefixes = list_prefixes(reader);
    for (const Section& section : reader.sections()) prefix.checksums.push_back(section.xxh3);
    return prefix;
}

LoadedAsset read_prefix(const std::filesystem::path& path, const FilePrefix& prefix,
                        uint64_t playable_bytes) {
    LoadedAsset loaded;
    loaded.asset = read_asset(path, {.prefix = true, .most_bytes = playable_bytes}, &loaded.units);
    loaded.progress = prefix.progress();
    if (playable_bytes < prefix.playable_bytes()) loaded.progress.size_bytes = playable_bytes;
    loaded.progress.components = num_components(loaded.asset->moving());
    return loaded;
}

Bounds bounds_so_far(const Asset& asset) {
    constexpr uint64_t kMaxMultiplyAdds = uint64_t{1} << 23;
    return sequence_bounds(asset, asset.complete ? kMaxBoundsMultiplyAdds : kMaxMultiplyAdds);
}

LoadedAsset load_prefix(const std::filesystem::path& path) {
    const FilePrefix prefix = inspect_prefix(path);
    LoadedAsset loaded = read_prefix(path, prefix, prefix.size_bytes);
    loaded.bounds = bounds_so_far(*loaded.asset);
    return loaded;
}

}  // namespace paim::player
