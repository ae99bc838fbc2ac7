// What encoding to a target is said to take.
#include "compressor/encode/memory/target_memory.h"

#include <gtest/gtest.h>

#include <bit>

#include "compressor/encode/search/transfer_encoder.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/error.h"

namespace paim {
namespace {

// Of all codecs of integers.
const std::vector<SearchedCodec> kAllCodecs = searched_codecs(encoders_to_try("", Precision::i16));

// 10000 vertices, 48 poses, 5 bands, 2 threads.
const TargetSize kOctopus{{19996, 10000, 48, 48, 2, 10000, 5}, 25, 12, 20, kAllCodecs};

// The same with svd alone, which holds nothing but the factors.
TargetSize octopus_of_svd() {
    TargetSize size = kOctopus;
    size.codecs = searched_codecs(encoders_to_try("svd", Precision::i16));
    return size;
}

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
    EXPECT_LT(target_memory_bytes(octopus_of_svd()), least);
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

// Gloss of 64 bands of light, 8 outgoing ones and three channels, as large as numbers can be, and a size
// at the end of what is added up.
TEST(TargetMemory, IsBeyondAllWhereItWouldOverflow) {
    TargetSize size = kOctopus;
    size.num_planes = 3 * 64 * 64 * 64;
    size.streamed.num_vertices = uint64_t{1} << 27;
    size.streamed.num_poses = 1 << 20;
    size.geometry_components = size.transfer_components = 1 << 20;
    EXPECT_EQ(target_memory_bytes(size), uint64_t{1} << 62);
    EXPECT_EQ(target_held_bytes(size), uint64_t{1} << 62);
    EXPECT_THROW(check_target_memory(size, kAllCodecs, uint64_t{1} << 40, "x.bake"), Error);
    size.streamed.num_vertices = 1 << 16;
    size.geometry_components = size.transfer_components = 4000;
    EXPECT_GT(target_memory_bytes(size), uint64_t{4} * size.num_planes * 4000 << 16);
    EXPECT_LT(target_memory_bytes(size), uint64_t{1} << 57);
}

TEST(TargetMemory, RefusesAndSaysWhatItNeeds) {
    const uint64_t least = target_memory_bytes(kOctopus);
    const uint64_t of_svd = target_memory_bytes(octopus_of_svd());
    EXPECT_NO_THROW(check_target_memory(kOctopus, kAllCodecs, least, "x.bake"));
    try {
        check_target_memory(kOctopus, kAllCodecs, least - 1, "x.bake");
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
    const TargetSize svd = octopus_of_svd();
    const uint64_t least = target_memory_bytes(svd);
    ASSERT_LT(least, target_memory_bytes(kOctopus));
    const auto refusal = [](const TargetSize& size, uint64_t limit) {
        try {
            check_target_memory(size, kAllCodecs, limit, "x.bake");
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

// Numbers that are easy to tell apart.
CodecMemory made_up_memory(const TargetSize& size) {
    CodecMemory memory;
    memory.kept_bytes = uint64_t{1} << 40;
    memory.coding_bytes = uint64_t{1} << 42;
    memory.preparing_bytes = uint64_t{1} << 44;
    memory.num_points = 2 * size.streamed.num_vertices;
    memory.num_points_each = 4;
    return memory;
}

TEST(TargetMemory, AddsUpOverCodecs) {
    TargetSize size = octopus_of_svd();
    const uint64_t held = target_held_bytes(size);
    size.codecs.push_back({"one", made_up_memory});
    EXPECT_EQ(target_held_bytes(size), held + (uint64_t{1} << 40));
    EXPECT_EQ(target_memory_bytes(size), target_held_bytes(size) + (uint64_t{1} << 44));
    // The coding of the first stays while the second prepares.
    size.codecs.push_back({"two", made_up_memory});
    EXPECT_EQ(target_held_bytes(size), held + (uint64_t{2} << 40));
    EXPECT_EQ(target_memory_bytes(size),
              target_held_bytes(size) + (uint64_t{1} << 42) + (uint64_t{1} << 44));
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
