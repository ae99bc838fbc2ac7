// What encoding to a target is said to take.
#include "compressor/encode/memory/target_memory.h"

#include <gtest/gtest.h>

#include <bit>

#include "compressor/encode/svd/tsqr.h"
#include "paim/base/error.h"

namespace paim {
namespace {

// 10000 vertices, 48 poses, 5 bands, 2 threads.
constexpr TargetSize kOctopus{{19996, 10000, 48, 48, 2, 10000, 5}, 25, 12, 20, true};

TEST(TargetMemory, GrowsWithEveryDimension) {
    const uint64_t least = target_memory_bytes(kOctopus);
    EXPECT_LT(target_held_bytes(kOctopus), least);
    TargetSize more = kOctopus;
    more.streamed.num_vertices *= 2;
    EXPECT_GT(target_memory_bytes(more), least);
    more = kOctopus;
    more.num_planes *= 3;
    EXPECT_GT(target_memory_bytes(more), least);
    more = kOctopus;
    more.transfer_components *= 2;
    EXPECT_GT(target_memory_bytes(more), least);
    more = kOctopus;
    more.geometry_components = 40;
    EXPECT_GT(target_memory_bytes(more), least);
    more = kOctopus;
    more.streamed.num_threads *= 2;
    EXPECT_GT(target_memory_bytes(more), least);
    more = kOctopus;
    more.clusters = false;
    EXPECT_LT(target_memory_bytes(more), least);
}

TEST(TargetMemory, HoldsTheFactors) {
    TargetSize size = kOctopus;
    // Mean and components of 25 and 3 planes, as floats.
    const uint64_t factors = uint64_t{4} * 10000 * (25 * 21 + 3 * 13);
    EXPECT_GT(target_held_bytes(size), factors);
    size.transfer_components += 10;
    EXPECT_GE(target_held_bytes(size) - target_held_bytes(kOctopus), uint64_t{4} * 10000 * 25 * 10);
}

TEST(TargetMemory, DoesNotOverflow) {
    TargetSize size = kOctopus;
    size.streamed.num_vertices = uint64_t{1} << 27;
    size.num_planes = 3 * 100;
    size.streamed.num_poses = size.transfer_components = size.geometry_components = 4000;
    EXPECT_GT(target_memory_bytes(size), uint64_t{4} * 300 * 4000 << 27);
    EXPECT_LT(target_memory_bytes(size), uint64_t{1} << 60);
}

TEST(TargetMemory, RefusesAndSaysWhatItNeeds) {
    const uint64_t least = target_memory_bytes(kOctopus);
    TargetSize svd = kOctopus;
    svd.clusters = false;
    const uint64_t of_svd = target_memory_bytes(svd);
    EXPECT_NO_THROW(check_target_memory(kOctopus, least, "x.bake"));
    try {
        check_target_memory(kOctopus, least - 1, "x.bake");
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_EQ(
            std::string(error.what()),
            "x.bake: 48 poses of 10000 vertices in 5 bands, with 12 and 20 components in memory, "
            "need " +
                memory_text(least) + " to be encoded to a target, but --memory allows " +
                memory_text(least - 2) + " (--codec svd alone takes " + memory_text(of_svd) + ")");
    }
}

TEST(TargetMemory, NamesSvdWhereThatWouldFit) {
    TargetSize svd = kOctopus;
    svd.clusters = false;
    const uint64_t least = target_memory_bytes(svd);
    ASSERT_LT(least, target_memory_bytes(kOctopus));
    const auto refusal = [](const TargetSize& size, uint64_t limit) {
        try {
            check_target_memory(size, limit, "x.bake");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("not refused");
    };
    const std::string instead = "(--codec svd alone takes " + memory_text(least) + ")";
    EXPECT_NE(refusal(kOctopus, least).find(instead), std::string::npos);
    EXPECT_EQ(refusal(kOctopus, least - 1).find("--codec svd"), std::string::npos);
    EXPECT_EQ(refusal(svd, least - 1).find("--codec svd"), std::string::npos);
    EXPECT_EQ(refusal(svd, least), "not refused");
}

TEST(TargetMemory, ReadsAsMuchAtOnceAsFits) {
    TargetSize size = kOctopus;
    size.streamed.num_poses = size.streamed.num_components = 1000;
    const uint64_t least = target_memory_bytes(size);
    const uint32_t few = choose_target_in_flight(size, least);
    const uint32_t many = choose_target_in_flight(size, 100 * least);
    EXPECT_TRUE(std::has_single_bit(few));
    EXPECT_LE(few, many);
    EXPECT_EQ(many, kMaxInFlight);
}

}  // namespace
}  // namespace paim
