// Positions meet distances, edges and normals, and are not much better than they need be.
#include "compressor/encode/search/position_search.h"

#include <gtest/gtest.h>

#include <utility>

#include "compressor/encode/search/quantise_still.h"
#include "compressor/encode/search/rate_control.h"
#include "paim/format/paim/paim_read.h"
#include "tests/unit/encode/search/target_encode_fixture.h"

namespace paim {
namespace {

class PositionSearch : public TargetEncode {
  protected:
    // A sheet whose RMS distance may be 2 % of the diagonal, so that its shape alone matters.
    EncodeTarget loose(const BakeReader& bake) const {
        EncodeTarget target = this->target(bake, 0.05);
        target.geometry_error = 0.02;
        target.sted = 0.9;
        target.normal_angle_deg = 90.0;
        return target;
    }
    SurfaceTarget surface_target(const EncodeProblem& problem, const EncodeTarget& target) const {
        return targets_of(target, 0.05, problem.best_achievable.geometry.diagonal).surface;
    }
    static RefinedPositions find(const EncodeProblem& problem, const SurfaceTarget& target) {
        auto coding = choose_positions(problem, Precision::i16, target);
        EXPECT_TRUE(coding.has_value());
        auto refined = refine_positions(problem, std::move(*coding), target);
        EXPECT_TRUE(refined.has_value());
        return std::move(*refined);
    }
};

// Each of the three binds in turn.
TEST_F(PositionSearch, EndsJustBelowTheErrorThatMattersMost) {
    const BakeReader bake = this->bake();
    std::vector<EncodeTarget> asked(3, loose(bake));
    asked[0].geometry_error = 1e-3;
    asked[1].sted = 0.02;
    asked[2].normal_angle_deg = 0.7;
    for (size_t binding = 0; binding < 3; ++binding) {
        const EncodeProblem problem = read_problem(bake, options_, asked[binding]);
        const SurfaceTarget target = surface_target(problem, asked[binding]);
        const RefinedPositions found = find(problem, target);
        EXPECT_FALSE(found.matrix.holds_floats());
        EXPECT_EQ(problem.meter->surface(found.matrix).geometry.rms(), found.error.geometry.rms());
        const double share[3] = {
            found.error.geometry.rms() / target.distance,
            found.error.shape.worst.sted() / target.sted,
            found.error.shape.worst.normal_angle_deg / target.normal_angle_deg};
        for (size_t j = 0; j < 3; ++j) {
            EXPECT_LE(share[j], 1.0) << binding << " " << j;
            EXPECT_TRUE(j == binding || share[j] < share[binding]) << "else this says little";
        }
        // Steps that 2000 values are rounded to change the error by jumps of a few percent.
        EXPECT_GT(share[binding], 0.9) << binding;
    }
}

// Where dropped components alone take all of the error, no step helps: a component is added, and
// positions stay integers.
TEST_F(PositionSearch, AddsAComponentWhereNoStepHelps) {
    const BakeReader bake = this->bake();
    EncodeTarget asked = loose(bake);
    asked.geometry_error = 1e-3;
    const EncodeProblem problem = read_problem(bake, options_, asked);
    const SurfaceTarget target = surface_target(problem, asked);
    auto coding = choose_positions(problem, Precision::i16, target);
    ASSERT_TRUE(coding.has_value());
    const uint32_t enough = coding->quantiser.num_components;
    ASSERT_GT(enough, 1u);
    coding->quantiser.num_components = enough - 1;
    ASSERT_GT(excess(problem.meter->surface(code_positions(problem, *coding)), target), 1.0);
    const auto refined = refine_positions(problem, *coding, target);
    ASSERT_TRUE(refined.has_value());
    EXPECT_FALSE(refined->matrix.holds_floats());
    EXPECT_EQ(refined->coding.quantiser.num_components, enough);
    EXPECT_LE(excess(refined->error, target), 1.0);
}

TEST_F(PositionSearch, HoldsTheComponentsThatTheShapeNeeds) {
    const BakeReader bake = this->bake();
    EncodeTarget asked = loose(bake);
    asked.geometry_error = 0.5;  // larger than the waves
    const uint32_t few = read_problem(bake, options_, asked).geometry.num_components();
    asked.normal_angle_deg = 0.01;
    const EncodeProblem problem = read_problem(bake, options_, asked);
    EXPECT_GT(problem.geometry.num_components(), few);
    EXPECT_LT(excess(problem.best_achievable, surface_target(problem, asked)), 0.3);
}

TEST_F(PositionSearch, TakesFloatsWhereIntegersAreTooCoarseForTheShape) {
    const BakeReader bake = this->bake();
    EncodeTarget asked = loose(bake);
    asked.normal_angle_deg = 1e-3;
    const EncodeProblem problem = read_problem(bake, options_, asked);
    const SurfaceTarget target = surface_target(problem, asked);
    const RefinedPositions found = find(problem, target);
    EXPECT_TRUE(found.matrix.holds_floats());
    EXPECT_LE(excess(found.error, target), 1.0);
}

TEST_F(PositionSearch, SaysWhatFloatsCannotMeetAndWhatTheyCan) {
    const BakeReader bake = this->bake();
    const auto allowed = [&](const EncodeTarget& asked, const std::string& before) {
        try {
            encode(bake, asked);
            ADD_FAILURE() << "not refused";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
            const std::string message = error.what();
            const size_t at = message.find(before);
            EXPECT_NE(at, std::string::npos) << message;
            if (at != std::string::npos) return std::stod(message.substr(at + before.size()));
        }
        return 1.0;
    };
    EncodeTarget asked = loose(bake);
    asked.normal_angle_deg = 1e-7;
    asked.normal_angle_deg = allowed(asked, "allow a --max-normal-angle of ");
    EXPECT_LE(encode(bake, asked).error.shape.worst.normal_angle_deg, *asked.normal_angle_deg);
    std::filesystem::remove(output_);
    asked = loose(bake);
    asked.sted = 1e-9;
    asked.sted = 0.01 * allowed(asked, "allow a --max-sted of ");
    EXPECT_LE(encode(bake, asked).error.shape.worst.sted(), *asked.sted);
}

TEST_F(PositionSearch, StillMeshesHaveShapesToo) {
    const BakeReader bake = this->bake({.still_noise = 0.001});
    EncodeTarget asked = loose(bake);
    const EncodeProblem problem = read_problem(bake, options_, asked);
    SurfaceTarget target = surface_target(problem, asked);
    const double before = quantise_still(problem, {.transfer = 0.05, .surface = target})
                              .error->shape.worst.normal_angle_deg;
    ASSERT_GT(before, 2.0) << "else this says little";
    target.normal_angle_deg = 1.0;
    const QuantisedStill still = quantise_still(problem, {.transfer = 0.05, .surface = target});
    EXPECT_FALSE(still.mesh->positions.holds_floats());
    EXPECT_LE(still.error->shape.worst.normal_angle_deg, 1.0);
    EXPECT_GT(still.error->shape.worst.normal_angle_deg, 0.7);
}

// Steps for another error are scaled by the surface error that allows least.
TEST_F(PositionSearch, StepsScaleWithTheStrictestError) {
    const BakeReader bake = this->bake();
    const EncodeProblem problem = read_problem(bake, options_, target(bake, 0.05));
    Coding coding;
    coding.positions.quantiser.step = 1.0;
    const Targets from{.transfer = 0.05, .surface = {1.0, 0.1, 5.0}};
    scale_steps(problem, from, {.transfer = 0.05, .surface = {1.1, 0.09, 5.0}}, coding);
    EXPECT_DOUBLE_EQ(coding.positions.quantiser.step, 0.9);
    scale_steps(problem, from, {.transfer = 0.05, .surface = {1.2, 0.12, 5.5}}, coding);
    EXPECT_DOUBLE_EQ(coding.positions.quantiser.step, 0.9 * 1.1);
}

TEST_F(PositionSearch, FilesStateTheTargetsThatTheyMet) {
    const BakeReader bake = this->bake();
    EncodeTarget asked = target(bake, 0.05);
    asked.sted = 0.03;
    const TargetSummary summary = encode(bake, asked);
    EXPECT_EQ(summary.targets.surface.sted, 0.03);
    EXPECT_NE(read_paim(output_).provenance_json.find(R"("sted_worst_piece":0.03)"),
              std::string::npos);
}

}  // namespace
}  // namespace paim
