// Files of bakes with outliers: all other positions are as good as without them.
#include <gtest/gtest.h>

#include <map>

#include "compressor/encode/encode.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/section_table.h"
#include "paim/metrics/prefix_error.h"
#include "tests/kept_motion.h"
#include "tests/unit/encode/search/target_encode_fixture.h"

namespace paim {
namespace {

// (pose, vertex) → position
using BadPositions = std::map<std::pair<uint32_t, uint32_t>, Vec3f>;
using MovePose = std::function<void(uint32_t pose, std::vector<float>& positions)>;

class OutlierEncode : public TargetEncode {
  protected:
    // The bake with other positions.
    BakeReader moved(const BakeReader& bake, const MovePose& move) const {
        const auto directory = directory_ / "moved.bake";
        std::filesystem::remove_all(directory);
        const BakeWriter writer(directory, bake.identity(), bake.topology(), bake.albedo());
        for (uint32_t p = 0; p < bake.num_poses(); ++p) {
            BakedPose pose = bake.read_pose(p);
            move(p, pose.positions);
            writer.write_pose(p, pose);
        }
        return BakeReader(directory);
    }

    BakeReader broken(const BakeReader& bake, const BadPositions& bad) const {
        return moved(bake, [&](uint32_t p, std::vector<float>& positions) {
            for (const auto& [place, position] : bad) {
                if (place.first != p) continue;
                for (uint32_t axis = 0; axis < 3; ++axis) {
                    positions[axis * (positions.size() / 3) + place.second] =
                        position[static_cast<int>(axis)];
                }
            }
        });
    }

    struct Made {
        Asset asset;
        AssetError error;
        PositionOutliers outliers;
    };

    // error  of the target; 0: components of default settings
    Made make(const BakeReader& bake, double error) const {
        if (error > 0.0) {
            TargetSummary summary = encode_to_target(bake, options_, target(bake, error), output_);
            return {read_paim(output_), summary.error, std::move(summary.outliers)};
        }
        EncodeOptions options = options_;
        if (is_integer(options.precision)) options.precision = Precision::f32;
        options.measure = true;
        EncodeSummary summary = paim::encode(bake, options, output_);
        return {read_paim(output_), summary.measured.value(), std::move(summary.outliers)};
    }

    // [P] of [3][V] of the bake
    static std::vector<std::vector<float>> decoded(const Asset& asset, const BakeReader& bake) {
        const CodedMesh& mesh = asset.moving();
        const std::vector<uint32_t> old_vertex =
            match_vertices(mesh.topology, asset.vertex_order, bake.topology(), "x", "triangles");
        std::vector<std::vector<float>> poses(bake.num_poses());
        std::vector<float> planes;
        PositionDecoder decoder;
        for (uint32_t p = 0; p < bake.num_poses(); ++p) {
            decoder.decode(mesh.positions, p, mesh.positions.num_components, planes);
            poses[p].resize(planes.size());
            for (size_t r = 0; r < planes.size(); ++r) {
                const size_t v = r % old_vertex.size();
                poses[p][r - v + old_vertex[v]] = planes[r];
            }
        }
        return poses;
    }

    // What is made of the broken bake is what is made of the clean one, but for the outliers.
    void expect_as_good(const Made& made, const Made& clean, const BakeReader& bake,
                        const BakeReader& clean_bake, const BadPositions& bad, double error,
                        double digits) const {
        EXPECT_EQ(made.outliers.all().size(), bad.size());
        EXPECT_EQ(made.error.outliers.num_vertices, bad.size());
        EXPECT_EQ(clean.error.outliers.num_vertices, 0u);
        // As many components of floats are kept as default settings or the target ask for: 1 % of the
        // motion, whose RMS is 0.15, or more. Steps of integers are tried until they fit.
        const double motion = 0.15;
        const double tolerance = error > 0.0 && is_integer(options_.precision)
                                     ? 1.25 * clean.error.geometry.rms() + 1e-6
                                     : 0.01 * motion;
        EXPECT_LT(made.error.geometry.rms(), tolerance);
        EXPECT_NEAR(made.error.geometry.diagonal, clean.error.geometry.diagonal, 1e-6);
        EXPECT_LT(made.error.shape.worst.sted(), 1.5 * clean.error.shape.worst.sted() + 0.003);
        const auto poses = decoded(made.asset, bake);
        double squares = 0.0;
        const size_t num_vertices = bake.identity().num_vertices;
        std::vector<float> baked(3 * num_vertices);
        for (uint32_t p = 0; p < bake.num_poses(); ++p) {
            clean_bake.read_position_rows(p, 0, baked.size(), baked.data());
            for (size_t r = 0; r < baked.size(); ++r) {
                const auto v = static_cast<uint32_t>(r % num_vertices);
                const double off = double{poses[p][r]} - double{baked[r]};
                const auto found = bad.find({p, v});
                if (found == bad.end()) {
                    squares += off * off;
                    continue;
                }
                const Vec3f& position = found->second;
                EXPECT_NEAR(poses[p][r], position[static_cast<int>(r / num_vertices)],
                            digits * position.cast<double>().norm() + 0.3 * motion);
            }
        }
        EXPECT_LT(std::sqrt(squares / static_cast<double>(num_vertices * bake.num_poses())),
                  tolerance);
        const Bounds bounds = sequence_bounds(made.asset), expected = sequence_bounds(clean.asset);
        EXPECT_LT((bounds.lower - expected.lower).cwiseAbs().maxCoeff(), 0.03f);
        EXPECT_LT((bounds.upper - expected.upper).cwiseAbs().maxCoeff(), 0.03f);
        EXPECT_LT(prefix_errors(made.asset.moving(), {}).position_rms[0], 1.0);
        // The last components of the file are the exceptions.
        const LowRank& positions = made.asset.moving().positions;
        EXPECT_GE(positions.num_usual_components() + 1,
                  clean.asset.moving().positions.num_components);
        const std::vector<ComponentId> order = component_order(made.asset);
        uint32_t k = positions.num_usual_components();
        EXPECT_LT(k, positions.num_components);
        for (auto at = order.end() - (positions.num_components - k); at != order.end(); ++at) {
            EXPECT_EQ(*at, (ComponentId{Attribute::geometry, k++}));
        }
    }
};

TEST_F(OutlierEncode, LeavesTheOtherPositionsAlone) {
    const std::vector<BadPositions> kinds = {
        {{{4, 100}, {5000, 4000, 0}}},
        {{{0, 7}, {1e30f, 0, -1e30f}}, {{9, 300}, {0, -60, 0}}},
        {{{3, 20}, {0, 70, 1}}, {{4, 20}, {0, 75, 2}}, {{4, 21}, {9, -70, 1}}}};
    const BakeReader clean_bake = bake();
    for (const Precision precision : {Precision::f32, Precision::f16, Precision::i16}) {
        options_.precision = precision;
        for (const double error : {0.0, 0.05}) {
            if (precision == Precision::f16 && error > 0.0) continue;
            const Made clean = make(clean_bake, error);
            for (const BadPositions& bad : kinds) {
                // Half floats have 11 digits.
                if (precision == Precision::f16 && bad.count({0, 7}) > 0) continue;
                const BakeReader bake = broken(clean_bake, bad);
                const double digits = precision == Precision::f16 ? 0x1p-11 : 1e-6;
                expect_as_good(make(bake, error), clean, bake, clean_bake, bad, error, digits);
            }
        }
    }
}

// A hand of few vertices swings, while all of the sheet travels 30 units.
TEST_F(OutlierEncode, KeepsTheMotionOfEveryVertex) {
    TargetBake sheet;
    sheet.num_poses = 16;
    const BakeReader walker = moved(bake(sheet), [&](uint32_t p, std::vector<float>& positions) {
        const size_t num_vertices = positions.size() / 3;
        const double time = 2.0 * kPi * p / sheet.num_poses;
        for (size_t v = 0; v < num_vertices; ++v) {
            positions[v] += 2.0f * static_cast<float>(p);
            if (v < 3)
                positions[2 * num_vertices + v] += static_cast<float>(0.3 * std::sin(5.0 * time));
        }
    });
    for (const double error : {0.0, 0.1}) {
        const Made made = make(walker, error);
        const double seen = made.error.geometry.diagonal * (error > 0.0 ? 0.002 : kInvisibleMotion);
        const KeptMotion kept = least_kept_motion(made.asset, walker, 10.0 * seen);
        EXPECT_GT(kept.share, 0.9) << kept.vertex << ": " << kept.baked;
        EXPECT_TRUE(made.outliers.empty());
    }
}

}  // namespace
}  // namespace paim
