// Prefixes of a .paim that can be played.
#include "paim/format/paim/prefixes.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "paim/format/container/sections.h"

namespace paim {

namespace {

// The ends in the file of the components of one attribute.
class ComponentEnds {
  public:
    // If several sections have the same index, the first one counts.
    void add(const Section& section, uint64_t end) { ends_.emplace(section.spec.index, end); }

    // For k = 0, 1, …: the size of the prefix that has components 0 … k.
    std::vector<uint64_t> running() const {
        std::vector<uint64_t> sizes;
        for (const auto& [index, end] : ends_) {
            if (index != sizes.size()) break;
            sizes.push_back(sizes.empty() ? end : std::max(sizes.back(), end));
        }
        return sizes;
    }

  private:
    std::map<uint32_t, uint64_t> ends_;
};

}  // namespace

std::vector<Prefix> list_prefixes(const ContainerReader& reader) {
    ComponentEnds ends[std::size(section::kComponent)];
    Prefix shortest;
    for (const Section& section : reader.sections()) {
        const uint64_t end = section.offset + section.stored_size_bytes;
        const auto* part = std::find(std::begin(section::kComponent), std::end(section::kComponent),
                                     section.spec.tag);
        if (part == std::end(section::kComponent)) {
            shortest.size_bytes = std::max(shortest.size_bytes, end);
        } else {
            ends[part - std::begin(section::kComponent)].add(section, end);
        }
    }
    std::vector<std::vector<uint64_t>> sizes;  // of each attribute
    for (const ComponentEnds& part : ends) sizes.push_back(part.running());
    std::vector<uint64_t> steps{shortest.size_bytes};
    for (const auto& part : sizes) {
        for (const uint64_t size : part) steps.push_back(std::max(size, shortest.size_bytes));
    }
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    std::vector<Prefix> prefixes;
    for (const uint64_t size_bytes : steps) {
        const auto count = [&](const std::vector<uint64_t>& part) {
            return static_cast<uint32_t>(std::upper_bound(part.begin(), part.end(), size_bytes) -
                                         part.begin());
        };
        prefixes.push_back({size_bytes, count(sizes[0]), count(sizes[1]), count(sizes[2])});
    }
    return prefixes;
}

std::vector<Prefix> read_prefixes(const std::filesystem::path& path) {
    return list_prefixes(ContainerReader(path, section::kKindAnimation, Extent::prefix));
}

}  // namespace paim
