// Pieces are the same with any hook and without one, cover everything once, and exceptions come
// through.
#include "paim/base/parallel.h"

#include <gtest/gtest.h>

#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "paim/base/parallel_hook.h"
#include "paim/base/tbb_parallel.h"

namespace paim {
namespace {

// Threads of a program's own: a new one for every index, from the last to the first, one at a time.
struct Lender {
    size_t num_loops = 0;
    std::vector<size_t> indices;

    static void run(void* user, size_t count, void (*body)(void*, size_t), void* context) {
        Lender& lender = *static_cast<Lender*>(user);
        ++lender.num_loops;
        for (size_t index = count; index-- > 0;) {
            lender.indices.push_back(index);
            std::thread([&] { body(context, index); }).join();
        }
    }
    static int three(void*) { return 3; }

    const ParallelHook hook{run, three, this};
};

// Puts the hook back that the other tests run with.
class HookOf : public testing::Test {
  protected:
    ~HookOf() override { use_tbb(); }
};
using NoHook = HookOf;
using GivenHook = HookOf;

using Pieces = std::vector<std::pair<size_t, size_t>>;

TEST_F(NoHook, LoopsRunInOrderOnTheCallingThread) {
    set_parallel_hook(nullptr);
    EXPECT_EQ(max_parallelism(), 1);
    const std::thread::id caller = std::this_thread::get_id();
    Pieces pieces;
    parallel_for(25, 10, [&](size_t begin, size_t end) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        pieces.emplace_back(begin, end);
    });
    EXPECT_EQ(pieces, (Pieces{{0, 10}, {10, 20}, {20, 25}}));
    parallel_for(0, 10, [&](size_t, size_t) { FAIL() << "expected no piece of nothing"; });
}

TEST_F(NoHook, ExceptionsComeThrough) {
    set_parallel_hook(nullptr);
    EXPECT_THROW(parallel_for(2, 1, [](size_t, size_t) { throw std::runtime_error("x"); }),
                 std::runtime_error);
}

TEST_F(GivenHook, RunsTheSamePieces) {
    Lender lender;
    set_parallel_hook(&lender.hook);
    EXPECT_EQ(max_parallelism(), 3);
    Pieces pieces;
    parallel_for(25, 10, [&](size_t begin, size_t end) { pieces.emplace_back(begin, end); });
    EXPECT_EQ(pieces, (Pieces{{20, 25}, {10, 20}, {0, 10}}));
    EXPECT_EQ(lender.num_loops, 1u);
    EXPECT_EQ(lender.indices, (std::vector<size_t>{2, 1, 0}));
}

TEST_F(GivenHook, RunsLoopsWithinLoops) {
    Lender lender;
    set_parallel_hook(&lender.hook);
    std::vector<int> visits(6);
    parallel_for(2, 1, [&](size_t outer, size_t) {
        parallel_for(3, 1, [&](size_t inner, size_t) { ++visits[3 * outer + inner]; });
    });
    EXPECT_EQ(visits, std::vector<int>(6, 1));
    EXPECT_EQ(lender.num_loops, 3u);
}

// The threads of a hook would end the program if an exception reached them.
TEST_F(GivenHook, ExceptionsPassItBy) {
    Lender lender;
    set_parallel_hook(&lender.hook);
    std::vector<size_t> begun;
    try {
        parallel_for(5, 1, [&](size_t begin, size_t) {
            begun.push_back(begin);
            if (begin <= 3) throw std::runtime_error(std::to_string(begin));
        });
        FAIL() << "expected an exception";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "3");  // the first one, as indices descend
    }
    EXPECT_EQ(begun, (std::vector<size_t>{4, 3}));  // and nothing begins after it
}

// Two pieces at once, of which number 1 fails while number 0 has begun, and number 0 after it.
TEST_F(GivenHook, TheFirstExceptionIsTheOneThatComesThrough) {
    std::latch zero_began(1), one_ended(1);
    const ParallelHook hook{[](void* user, size_t, void (*body)(void*, size_t), void* context) {
                                std::thread zero([&] { body(context, 0); });
                                body(context, 1);
                                static_cast<std::latch*>(user)->count_down();
                                zero.join();
                            },
                            Lender::three, &one_ended};
    set_parallel_hook(&hook);
    try {
        parallel_for(2, 1, [&](size_t begin, size_t) {
            if (begin == 0) {
                zero_began.count_down();
                one_ended.wait();
            } else {
                zero_began.wait();
            }
            throw std::runtime_error(std::to_string(begin));
        });
        FAIL() << "expected an exception";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "1");
    }
}

}  // namespace
}  // namespace paim
