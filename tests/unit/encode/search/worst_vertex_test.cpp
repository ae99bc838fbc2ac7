// From an error to a file whose worst vertex is bounded.
#include <gtest/gtest.h>

#include <string>

#include "paim/format/paim/paim_read.h"
#include "tests/unit/encode/search/target_encode_fixture.h"

namespace paim {
namespace {

class WorstVertex : public TargetEncode {};

// The error of the transfer is then smaller than what is asked for, and the file larger.
TEST_F(WorstVertex, IsBounded) {
    const BakeReader bake = this->bake();
    for (const std::string codec : {"svd", "cpca"}) {
        EncodeTarget asked = target(bake, 0.05, codec);
        const TargetSummary any = encode(bake, asked);
        asked.vertex_error = 0.7 * any.error.transfer.worst_vertex_error_to_bake;
        const TargetSummary bounded = encode(bake, asked);
        EXPECT_LE(bounded.error.transfer.worst_vertex_error_to_bake, *asked.vertex_error);
        // Not much better than it need be: the worst of 400 vertices changes by jumps.
        EXPECT_GT(bounded.error.transfer.worst_vertex_error_to_bake, 0.6 * *asked.vertex_error);
        EXPECT_GT(bounded.size_bytes, any.size_bytes);
        EXPECT_EQ(bounded.targets.transfer, 0.05);
        EXPECT_NE(read_paim(output_).provenance_json.find("transfer_worst_vertex_deviation"),
                  std::string::npos);
        // A bound that is met anyhow changes nothing but what the file states.
        asked.vertex_error = 1.01 * any.error.transfer.worst_vertex_error_to_bake;
        EXPECT_EQ(encode(bake, asked).error.transfer.total(), any.error.transfer.total());
    }
}

// With a size, too: the file that fits has no worse vertex.
TEST_F(WorstVertex, OfFilesOfASizeIsBounded) {
    const BakeReader bake = this->bake();
    EncodeTarget asked = target(bake, 0.05, "svd");
    asked.transfer_error.reset();
    asked.size_bytes = 12'000;
    const double worst = encode(bake, asked).error.transfer.worst_vertex_error_to_bake;
    asked.vertex_error = 1.1 * worst;
    EXPECT_LE(encode(bake, asked).error.transfer.worst_vertex_error_to_bake, *asked.vertex_error);
    std::filesystem::remove(output_);
    asked.vertex_error = 0.3 * worst;
    EXPECT_THROW(encode(bake, asked), Error);
}

TEST_F(WorstVertex, IsRefusedWhereNoiseLeavesMore) {
    const BakeReader bake = this->bake({.noise = 0.01});
    EncodeTarget asked = target(bake, 0.1);
    asked.vertex_error = 0.001;
    expect_refused(bake, asked, ExitCode::threshold_exceeded, "allow a --max-vertex-error of");
}

}  // namespace
}  // namespace paim
