// The plan of encoding's memory: what it grows with, what fits, and what is refused.
#include "compressor/encode/memory/memory_plan.h"

#include <gtest/gtest.h>

#include <bit>

#include "compressor/encode/svd/tsqr.h"
#include "paim/base/error.h"

namespace paim {
namespace {

constexpr uint64_t kGigabyte = 1'000'000'000;

// An animation of the paper's size, all components.
constexpr EncodeSize kPaper{208000, 1, 103, 103, 2, 104000, 5};

EncodeSize with_poses(uint64_t num_poses) {
    EncodeSize size = kPaper;
    size.num_poses = size.num_components = num_poses;
    return size;
}

TEST(MemoryPlan, ThePapersAnimationFitsTheLeastThatMayBeAsked) {
    EXPECT_EQ(choose_num_in_flight(kPaper, kGigabyte, "x.bake"), kMaxInFlight);
    EXPECT_LE(encode_memory_bytes(kPaper, 1), 64'000'000u);
}

TEST(MemoryPlan, GrowsWithWhatIsInFlightAndWithPoses) {
    for (uint32_t in_flight = 1; in_flight < kMaxInFlight; in_flight *= 2) {
        EXPECT_LE(encode_memory_bytes(kPaper, in_flight),
                  encode_memory_bytes(kPaper, 2 * in_flight));
    }
    // With fewer, 2 MB of blocks count for more than they do.
    for (uint64_t poses = 64; poses < uint64_t{1} << 20; poses *= 2) {
        EXPECT_LT(encode_memory_bytes(with_poses(poses), 4),
                  encode_memory_bytes(with_poses(2 * poses), 4));
    }
}

TEST(MemoryPlan, TakesTheMostThatFits) {
    const EncodeSize size = with_poses(1000);
    for (const uint64_t limit : {200'000'000u, 300'000'000u, 400'000'000u, 1'000'000'000u}) {
        const uint32_t chosen = choose_num_in_flight(size, limit, "x.bake");
        EXPECT_TRUE(std::has_single_bit(chosen));
        EXPECT_LE(encode_memory_bytes(size, chosen), limit);
        if (chosen < kMaxInFlight) {
            EXPECT_GT(encode_memory_bytes(size, 2 * chosen), limit);
        }
    }
}

TEST(MemoryPlan, RefusesMorePosesThanFitAndSaysWhatTheyNeed) {
    // Doubles of 16 matrices and more of 2^20 squared: terabytes, and no overflow.
    EXPECT_GT(encode_memory_bytes(with_poses(uint64_t{1} << 20), 1), uint64_t{16} * 8 << 40);
    EXPECT_LT(encode_memory_bytes(with_poses(uint64_t{1} << 20), kMaxInFlight), uint64_t{1} << 60);
    try {
        choose_num_in_flight(with_poses(10000), kGigabyte, "x.bake");
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_STREQ(
            error.what(),
            "x.bake: 10000 poses of 104000 vertices in 5 bands need 13 GB of memory to be encoded, "
            "but --memory allows 1000 MB");
    }
}

}  // namespace
}  // namespace paim
