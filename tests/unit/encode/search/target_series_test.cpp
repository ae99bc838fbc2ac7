// A series of targets: the files of single encodes, whatever was encoded before.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "compressor/encode/search/cpca/clusterings.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "paim/base/file.h"
#include "tests/unit/encode/search/target_encode_fixture.h"

namespace paim {
namespace {

std::vector<char> file_bytes(const std::filesystem::path& path) {
    return read_file(path, uint64_t{1} << 30);
}

class TargetSeriesTest : public TargetEncode {
  protected:
    // Expects the file that encode_to_target() writes, and the same summary.
    void expect_as_alone(TargetSeries& series, const BakeReader& bake, const EncodeTarget& target) {
        const std::filesystem::path together = directory_ / "together.paim";
        const TargetSummary summary = series.encode(target, together);
        const TargetSummary alone = encode(bake, target);
        EXPECT_TRUE(file_bytes(together) == file_bytes(output_))
            << target.codec << ", " << *target.transfer_error;
        EXPECT_EQ(summary.size_bytes, alone.size_bytes);
        EXPECT_EQ(summary.best_achievable, alone.best_achievable);
        EXPECT_EQ(summary.error.transfer.total(), alone.error.transfer.total());
        EXPECT_EQ(summary.error.geometry.rms(), alone.error.geometry.rms());
        EXPECT_EQ(summary.chosen().multiply_adds, alone.chosen().multiply_adds);
    }
};

TEST_F(TargetSeriesTest, FilesAreThoseOfSingleEncodes) {
    const BakeReader bake = this->bake({.noise = 0.02});
    std::set<uint32_t> held;  // numbers of components
    for (const uint32_t bands : {4u, 3u}) {
        options_.bands = bands;
        TargetSeries series(bake, options_, BandPower::flat(4));
        const double floor = series.least_error();
        // Up and down, so that components come and go.
        for (const double above : {8.0, 1.2, 2.0, 1.2}) {
            held.insert(read_problem(bake, options_, target(bake, above * floor))
                            .transfer.num_components());
            for (const TransferEncoderType& type : transfer_encoders()) {
                for (const Preference preference : {Preference::size, Preference::speed}) {
                    EncodeTarget one = target(bake, above * floor, std::string(type.codec));
                    one.preference = preference;
                    expect_as_alone(series, bake, one);
                }
            }
        }
    }
    EXPECT_GT(held.size(), 1u) << "else this would not say much";
}

TEST_F(TargetSeriesTest, GoesOnAfterATargetThatCannotBeMet) {
    const BakeReader bake = this->bake({.noise = 0.02});
    TargetSeries series(bake, options_, BandPower::flat(4));
    expect_as_alone(series, bake, target(bake, 0.1, "cpca"));
    EXPECT_THROW(series.encode(target(bake, 1e-5, "cpca"), output_), Error);
    expect_as_alone(series, bake, target(bake, 0.1, "cpca"));
}

// The shape of the surface asks for other components of the positions than their distance.
TEST_F(TargetSeriesTest, PositionsComeAndGo) {
    const BakeReader bake = this->bake();
    TargetSeries series(bake, options_, BandPower::flat(4));
    EncodeTarget loose = target(bake, 0.05, "svd");
    loose.geometry_error = 0.5;  // larger than the waves
    loose.sted = 0.9;
    loose.normal_angle_deg = 90.0;
    EncodeTarget tight = loose;
    tight.normal_angle_deg = 0.2;
    ASSERT_LT(read_problem(bake, options_, loose).geometry.num_components(),
              read_problem(bake, options_, tight).geometry.num_components());
    expect_as_alone(series, bake, loose);
    expect_as_alone(series, bake, tight);
    expect_as_alone(series, bake, loose);
    // For a size, components are held by the distance alone. With those the same surface cannot be
    // met, but with those for an error it can.
    EncodeTarget sized = tight;
    sized.transfer_error.reset();
    sized.size_bytes = 1'000'000;
    EXPECT_THROW(series.encode(sized, output_), Error);
    expect_as_alone(series, bake, tight);
}

// The best that any file can have, whatever was asked for before.
TEST_F(TargetSeriesTest, LeastErrorIsThatOfVeryGoodFiles) {
    const BakeReader bake = this->bake({.noise = 0.02});
    TargetSeries series(bake, options_, BandPower::flat(4));
    series.prepare(target(bake, 0.3));
    const double least = series.least_error();
    EXPECT_EQ(least, read_problem(bake, options_, target(bake, 0.001)).least_error());
    EXPECT_LT(least, read_problem(bake, options_, target(bake, 0.3)).least_error());
}

TEST_F(TargetSeriesTest, ClusteringsAreFoundOnce) {
    const BakeReader bake = this->bake();
    const EncodeProblem problem = read_problem(bake, options_, target(bake, 0.02));
    Clusterings clusterings;
    const auto first = clusterings.find(problem, 16, 4, 1'000'000'000);
    const auto other = clusterings.find(problem, 16, 8, 1'000'000'000);
    EXPECT_NE(first, other);
    EXPECT_EQ(clusterings.find(problem, 16, 4, 1'000'000'000), first);
    // Those that were forgotten are found again, and are the same.
    clusterings.forget(16, 4);
    const auto again = clusterings.find(problem, 16, 4, 1'000'000'000);
    EXPECT_NE(again, first);
    EXPECT_EQ(again->cluster, first->cluster);
    EXPECT_EQ(again->coefficients, first->coefficients);
}

TEST_F(TargetSeriesTest, PositionsAreFoundOnce) {
    const BakeReader bake = this->bake();
    const EncodeTarget asked = target(bake, 0.02);
    const EncodeProblem problem = read_problem(bake, options_, asked);
    PositionFinder search(problem, Precision::i16);
    SurfaceTarget surface =
        targets_of(asked, 0.02, problem.best_achievable.geometry.diagonal).surface;
    const PositionCoding coding = *search.choose(surface);
    EXPECT_EQ(coding, *choose_positions(problem, Precision::i16, surface));
    const RefinedPositions refined = *search.refine(coding, surface);
    EXPECT_EQ(refined.coding, refine_positions(problem, coding, surface)->coding);
    surface.distance *= 2.0;
    surface.sted *= 2.0;
    surface.normal_angle_deg *= 2.0;
    EXPECT_NE(*search.choose(surface), coding);
    EXPECT_NE(search.refine(coding, surface)->coding, refined.coding);
}

}  // namespace
}  // namespace paim
