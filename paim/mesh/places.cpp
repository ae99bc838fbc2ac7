// Vertices that lie exactly where others do.
#include "paim/mesh/places.h"

#include <bit>
#include <limits>

#include "paim/base/check.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

constexpr uint32_t kNoEntry = std::numeric_limits<uint32_t>::max();

// [n] The lowest index with an equal key; empty if all keys differ. A table of open addresses: keys
// are entered in order, so that the first of equal ones stays.
template <typename Hash, typename Equal>
std::vector<uint32_t> first_with_equal_key(size_t n, const Hash& hash, const Equal& equal) {
    const size_t mask = std::bit_ceil(2 * n + 1) - 1;
    std::vector<uint32_t> table(mask + 1, kNoEntry);
    std::vector<uint32_t> first(n);
    bool any = false;
    for (uint32_t v = 0; v < n; ++v) {
        size_t at = hash(v) & mask;
        while (table[at] != kNoEntry && !equal(table[at], v)) at = (at + 1) & mask;
        if (table[at] == kNoEntry) {
            table[at] = v;
        } else {
            any = true;
        }
        first[v] = table[at];
    }
    if (!any) first.clear();
    return first;
}

template <typename Vector>
std::vector<uint32_t> find_places(std::span<const Vector> positions,
                                  std::span<const uint32_t> within) {
    if (!within.empty()) PAIM_CHECK_EQ(within.size(), positions.size());
    const auto hash = [&](uint32_t v) {
        uint64_t bits = within.empty() ? 0 : within[v];
        for (Eigen::Index i = 0; i < 3; ++i) {
            // Adding 0 makes 0 of −0.
            bits = mix_bits(bits ^ std::bit_cast<uint64_t>(double{positions[v][i]} + 0.0));
        }
        return bits;
    };
    const auto equal = [&](uint32_t u, uint32_t v) {
        return positions[u] == positions[v] && (within.empty() || within[u] == within[v]);
    };
    return first_with_equal_key(positions.size(), hash, equal);
}

}  // namespace

std::vector<uint32_t> first_at_position(std::span<const Vec3f> positions,
                                        std::span<const uint32_t> within) {
    return find_places(positions, within);
}

std::vector<uint32_t> first_at_position(std::span<const Vec3d> positions,
                                        std::span<const uint32_t> within) {
    return find_places(positions, within);
}

std::vector<uint32_t> shared_places(std::span<const uint32_t> a, std::span<const uint32_t> b) {
    if (a.empty() || b.empty()) return {};
    PAIM_CHECK_EQ(a.size(), b.size());
    const auto hash = [&](uint32_t v) { return mix_bits(uint64_t{a[v]} << 32 | b[v]); };
    const auto equal = [&](uint32_t u, uint32_t v) { return a[u] == a[v] && b[u] == b[v]; };
    return first_with_equal_key(a.size(), hash, equal);
}

}  // namespace paim
