// Pieces are the same on any number of threads, cover everything once, and exceptions come through.
#include "paim/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <vector>

namespace paim {
namespace {

std::set<std::pair<size_t, size_t>> pieces(int num_threads, size_t count, size_t grain) {
    const ThreadLimit limit(num_threads);
    std::mutex mutex;
    std::set<std::pair<size_t, size_t>> result;
    parallel_for(count, grain, [&](size_t begin, size_t end) {
        const std::lock_guard lock(mutex);
        result.emplace(begin, end);
    });
    return result;
}

TEST(ParallelFor, CutsTheSamePiecesOnAnyNumberOfThreads) {
    EXPECT_EQ(pieces(1, 1001, 10), pieces(2, 1001, 10));
    EXPECT_EQ(pieces(2, 1001, 10).size(), 101u);
    EXPECT_TRUE(pieces(2, 0, 10).empty());
}

TEST(ParallelFor, VisitsEveryItemOnce) {
    std::vector<std::atomic<int>> visits(997);
    parallel_for(visits.size(), 7, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
}

TEST(ParallelFor, RethrowsExceptions) {
    EXPECT_THROW(parallel_for(100, 1,
                              [](size_t begin, size_t) {
                                  if (begin == 50) throw std::runtime_error("x");
                              }),
                 std::runtime_error);
}

TEST(ThreadLimit, IsSeenWhileItLives) {
    const int before = max_parallelism();
    {
        const ThreadLimit limit(1);
        EXPECT_EQ(max_parallelism(), 1);
    }
    EXPECT_EQ(max_parallelism(), before);
}

}  // namespace
}  // namespace paim
