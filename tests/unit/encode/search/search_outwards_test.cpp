// The smallest of a row of sizes is found without trying all.
#include "compressor/encode/search/search_outwards.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace paim {
namespace {

struct Searched {
    size_t best = 0;
    std::set<size_t> tried;
};

// 0 stands for no size.
Searched searched(const std::vector<uint64_t>& sizes, size_t start) {
    Searched result;
    result.best = search_outwards(sizes.size(), start, [&](size_t n) -> std::optional<uint64_t> {
        EXPECT_TRUE(result.tried.insert(n).second) << n << " was tried twice";
        if (sizes[n] == 0) return std::nullopt;
        return sizes[n];
    });
    return result;
}

TEST(SearchOutwards, FindsTheSmallestFromAnywhere) {
    const std::vector<uint64_t> sizes{900, 700, 500, 490, 600, 800, 1000};
    for (size_t start = 0; start < sizes.size(); ++start) {
        EXPECT_EQ(searched(sizes, start).best, 3u) << start;
    }
    EXPECT_EQ(searched(sizes, 3).tried, (std::set<size_t>{1, 2, 3, 4}));
}

TEST(SearchOutwards, IsNotStoppedByScatter) {
    EXPECT_EQ(searched({500, 505, 480, 700}, 0).best, 2u);
    EXPECT_EQ(searched({480, 505, 500, 700}, 2).best, 0u);
}

TEST(SearchOutwards, PassesByPlacesWithoutASize) {
    EXPECT_EQ(searched({0, 0, 0, 300, 200, 400}, 1).best, 4u);
    // Below one without a size nothing is tried.
    EXPECT_EQ(searched({0, 0, 0, 204, 200, 400}, 4).tried, (std::set<size_t>{2, 3, 4, 5}));
    EXPECT_EQ(searched({0, 0, 0}, 1).best, 1u);
    EXPECT_EQ(searched({}, 0).tried.size(), 0u);
}

TEST(SearchOutwards, GoesDownFromWhatIsTooLarge) {
    const Searched found = searched({500, 400, 450, kTooLarge, kTooLarge, kTooLarge}, 4);
    EXPECT_EQ(found.best, 1u);
    EXPECT_EQ(found.tried, (std::set<size_t>{0, 1, 2, 3, 4}));
}

}  // namespace
}  // namespace paim
