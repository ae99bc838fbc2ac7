// Loops on oneTBB: they do run there, pieces are the same on any number of threads, cover
// everything once, and exceptions come through.
#include "paim/base/tbb_parallel.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "paim/base/parallel.h"
#include "paim/base/parallel_hook.h"

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

// Whether oneTBB runs the pieces of a loop. A new thread belongs to it from its first loop on only.
bool loops_run_on_tbb() {
    std::atomic<int> num_on_tbb{0};
    std::thread([&] {
        parallel_for(8, 1, [&](size_t, size_t) {
            const int index = tbb::this_task_arena::current_thread_index();
            if (index != tbb::task_arena::not_initialized) ++num_on_tbb;
        });
    }).join();
    return num_on_tbb == 8;
}

TEST(UseTbb, MakesLoopsRunOnTbb) {
    EXPECT_TRUE(loops_run_on_tbb());  // as main() asks for it
    set_parallel_hook(nullptr);
    EXPECT_FALSE(loops_run_on_tbb());
    use_tbb();
    EXPECT_TRUE(loops_run_on_tbb());
}

TEST(UseTbb, CutsTheSamePiecesOnAnyNumberOfThreads) {
    EXPECT_EQ(pieces(1, 1001, 10), pieces(2, 1001, 10));
    EXPECT_EQ(pieces(2, 1001, 10).size(), 101u);
    EXPECT_TRUE(pieces(2, 0, 10).empty());
}

TEST(UseTbb, VisitsEveryItemOnce) {
    std::vector<std::atomic<int>> visits(997);
    parallel_for(visits.size(), 7, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
}

TEST(UseTbb, RethrowsExceptions) {
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
