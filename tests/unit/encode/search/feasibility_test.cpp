// What a bake cannot give is refused, with the reason that weighs most and the best there is.
#include "compressor/encode/search/feasibility.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "compressor/encode/search/less_noise.h"
#include "paim/base/error.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

class Feasibility : public testing::Test {
  protected:
    Feasibility() {
        EncodeTarget target;
        target.transfer_error = 0.1;
        target.spectrum = BandPower::flat(4);
        problem_.emplace(read_problem(bake_, {}, target));
    }

    // What check_feasible() says; empty if nothing.
    std::string refusal(double transfer_error) const {
        try {
            check_feasible(*problem_, transfer_error);
            return {};
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
            return error.what();
        }
    }

    std::string name() const { return (directory_ / "x.bake").string(); }

    const TemporaryDirectory directory_;
    const BakeReader bake_ = write_target_bake(directory_ / "x.bake", {.width = 4, .num_poses = 3});
    std::optional<EncodeProblem> problem_;
};

TEST_F(Feasibility, AllowsWhatIsAboveTheBestThereIs) {
    problem_->best_achievable.transfer.error = 0.03;
    problem_->best_achievable.transfer.missing_bands = 0.04;
    EXPECT_EQ(refusal(0.0501), "");  // √(0.03² + 0.04²) = 0.05
    EXPECT_NE(refusal(0.0499), "");
    problem_->best_achievable.transfer.missing_bands = 0.0;
    EXPECT_EQ(refusal(0.0301), "");
    EXPECT_NE(refusal(0.03), "");  // nothing is left for coding it
}

TEST_F(Feasibility, SaysWhetherNoiseOrBandsAreInTheWay) {
    TransferError& best = problem_->best_achievable.transfer;
    best.error = 0.04;
    best.missing_bands = 0.03;
    EXPECT_EQ(refusal(0.035), name() +
                                  ": a transfer error of 3.5 % is asked for, but the bake's noise "
                                  "leaves 5 % at best: " +
                                  less_noise_hint(bake_.identity(), best, 0.035));
    // No rays bring back what bands leave out.
    const std::string bands_leave = " % is asked for, but its 4 bands leave out ";
    const std::string shows = " % of what light of this spectrum shows: the best is 5 %; ";
    EXPECT_EQ(refusal(0.02), name() + ": a transfer error of 2" + bands_leave + "3" + shows +
                                 "bake with more --bands and more --rays");
    std::swap(best.error, best.missing_bands);
    EXPECT_EQ(refusal(0.035), name() + ": a transfer error of 3.5" + bands_leave + "4" + shows +
                                  "bake with more --bands");
    // Bands that were not asked for are an error, and no bands that the bake lacks.
    best.error = 0.05;
    best.missing_bands = 0.0;
    problem_->layout.in_bands = 2;
    EXPECT_EQ(refusal(0.02),
              name() +
                  ": a transfer error of 2 % is asked for, but 2 of its 4 bands leave "
                  "5 % at best: keep more --bands");
}

// Of gloss it is the gloss, and its options.
TEST_F(Feasibility, NamesTheOptionsOfGloss) {
    problem_->layout.kind = TransferKind::glossy;
    TransferError& best = problem_->best_achievable.transfer;
    best.error = 0.04;
    best.missing_bands = 0.03;
    best.worst_vertex_error_to_bake = 0.2;
    const std::string asked = name() + ": a gloss error of ";
    EXPECT_EQ(refusal(0.035), asked +
                                  "3.5 % is asked for, but the bake's noise leaves 5 % at best: " +
                                  less_noise_hint(bake_.identity(), best, 0.035));
    EXPECT_EQ(refusal(0.02), asked +
                                 "2 % is asked for, but its 4 bands of light leave out 3 % of what "
                                 "light of this spectrum shows: the best is 5 %; bake with more "
                                 "--gloss-bands and more --rays");
    try {
        check_vertex_feasible(*problem_, 0.1);
        FAIL();
    } catch (const TooNoisy& error) {
        EXPECT_EQ(
            error.what(),
            name() +
                ": a worst vertex of 10 % is asked for, but the gloss of one has 20 % at best "
                "once noise is taken out: bake with more --rays, or allow a "
                "--max-vertex-error of 21% or more");
    }
}

TEST_F(Feasibility, CountsWhatStandsStillToo) {
    problem_->best_achievable.transfer = {};
    problem_->best_achievable.still.emplace();
    problem_->best_achievable.still->transfer.error = 0.03;
    EXPECT_EQ(refusal(0.031), "");
    EXPECT_EQ(refusal(0.02), name() +
                                 ": a transfer error of 2 % is asked for, but in the still meshes "
                                 "the bake's noise leaves 3 % at best: " +
                                 less_noise_hint(bake_.identity(),
                                                 problem_->best_achievable.still->transfer, 0.02));
    EXPECT_EQ(problem_->least_error(), 0.03);
}

// Which kind of refusal it is: rays that would do, or nothing.
TEST_F(Feasibility, SaysHowManyRaysWouldDo) {
    const auto rays_of = [&](const auto& refuse) -> std::optional<uint32_t> {
        try {
            refuse();
        } catch (const TooNoisy& noisy) {
            return noisy.rays();
        } catch (const Error&) {
        }
        return std::nullopt;
    };
    const BakeIdentity& identity = bake_.identity();
    TransferError& best = problem_->best_achievable.transfer;
    best.error = 0.04;
    best.worst_vertex_error_to_bake = 0.1;
    EXPECT_EQ(rays_of([&] { check_feasible(*problem_, 0.02); }), rays_for(identity, best, 0.02));
    EXPECT_EQ(rays_of([&] { check_vertex_feasible(*problem_, 0.05); }),
              rays_for(identity, best, 0.02));  // twice as large, either way
    // Where little is left for coding. Where enough is, noise is not to blame.
    EXPECT_EQ(rays_of([&] { throw_missed(*problem_, 0.041, "x"); }),
              rays_for(identity, best, 0.041));
    EXPECT_EQ(rays_of([&] { throw_missed(*problem_, 0.05, "x"); }), std::nullopt);
    best.missing_bands = 0.03;
    EXPECT_EQ(rays_of([&] { check_feasible(*problem_, 0.02); }), std::nullopt);
}

// As many as the part and the target need that need the most.
TEST_F(Feasibility, RaysMeetTheWholeTarget) {
    const BakeIdentity& identity = bake_.identity();
    TransferError error;
    error.error = 0.04;
    problem_->best_achievable.transfer = error;
    EncodeTarget target;
    target.transfer_error = 0.02;
    EXPECT_EQ(rays_to_meet(*problem_, target), rays_for(identity, error, 0.02));
    problem_->best_achievable.still.emplace();
    problem_->best_achievable.still->transfer.error = 0.08;
    EXPECT_EQ(rays_to_meet(*problem_, target), rays_for(identity, error, 0.01));
    problem_->best_achievable.transfer.worst_vertex_error_to_bake = 0.3;
    target.vertex_error = 0.03;
    EXPECT_EQ(rays_to_meet(*problem_, target), rays_for(identity, error, 0.004));
    problem_->best_achievable.transfer.missing_bands = 0.02;
    EXPECT_THROW(rays_to_meet(*problem_, target), Error);
}

}  // namespace
}  // namespace paim
