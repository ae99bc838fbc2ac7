// What a reader accepts decodes to finite numbers, whatever the pose and however much of it is
// used. What it refuses is not written.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "paim/base/error.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"
#include "tests/unchecked_file.h"

namespace paim {
namespace {

bool decodes_to_finite_numbers(const Asset& asset) {
    for (const CodedMesh& mesh : asset.parts) {
        MeshDecoder decoder(mesh);
        DecodedPose pose;
        for (uint32_t components = 0; components <= 3; ++components) {
            for (double time = 0.0; time <= 4.0; time += 0.5) {
                DecodeLimits limits;
                limits.geometry_components = limits.transfer_components = components;
                decoder.decode(time, limits, pose);
                const auto finite = [](float value) { return std::isfinite(value); };
                if (!std::all_of(pose.positions.begin(), pose.positions.end(), finite) ||
                    !std::all_of(pose.transfer.begin(), pose.transfer.end(), finite)) {
                    return false;
                }
            }
        }
    }
    return true;
}

class FiniteValues : public testing::Test {
  protected:
    // Multiplies the numbers that `numbers_of` picks by ever more, up to the largest float.
    // Whatever is read back has to decode to finite numbers, and what surely does not is refused,
    // by readers and by writers.
    void grow(Asset asset, const std::function<std::vector<float>&(Asset&)>& numbers_of) {
        uint32_t num_read = 0, num_refused = 0;
        for (int exponent = 0; exponent <= 126; exponent += 3) {
            Asset grown = asset;
            for (float& number : numbers_of(grown)) {
                number = std::clamp(std::ldexp(number, exponent), -kMaxStep, kMaxStep);
            }
            write_unchecked(directory_ / "x.paim", asset, grown);
            const bool is_read = is_done([&] {
                EXPECT_TRUE(decodes_to_finite_numbers(read_paim(directory_ / "x.paim")))
                    << "2^" << exponent;
            });
            ++(is_read ? num_read : num_refused);
            std::filesystem::remove(directory_ / "x.paim");
            EXPECT_EQ(is_done([&] { write_paim(directory_ / "x.paim", grown); }), is_read)
                << "2^" << exponent;
            EXPECT_EQ(std::filesystem::exists(directory_ / "x.paim"), is_read);
        }
        EXPECT_GT(num_read, 20u) << "ordinary numbers must be read";
        EXPECT_GT(num_refused, 0u) << "else this says nothing";
    }

    // Whether it is not refused.
    template <typename Step>
    static bool is_done(const Step& step) {
        try {
            step();
            return true;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
            return false;
        }
    }

    static std::vector<float>& scales(Asset& asset) {
        return asset.moving().transfer.as<CpcaTransfer>()->clusters.scales;
    }

    const TemporaryDirectory directory_;
};

TEST_F(FiniteValues, OfIntegersTimesSteps) {
    Asset asset = quantise_example(make_example_asset());
    CodedMesh& mesh = asset.moving();
    for (LowRank* matrix : {&mesh.positions, &mesh.transfer->matrix}) {
        matrix->mean = std::vector<int16_t>(matrix->num_rows(), 32767);
        for (StoredValues& component : matrix->components) component = matrix->mean;
    }
    grow(asset, [](Asset& a) -> std::vector<float>& { return a.moving().positions.steps; });
    grow(asset, [](Asset& a) -> std::vector<float>& { return a.moving().transfer->matrix.steps; });
}

// What no reader would take is not written.
TEST_F(FiniteValues, OfStepsAreAskedForBeforeWriting) {
    const auto steps_of = [](Asset& a) -> std::array<std::vector<float>*, 2> {
        return {&a.moving().positions.steps, &a.moving().transfer->matrix.steps};
    };
    const Asset asset = quantise_example(make_example_asset());
    for (size_t which = 0; which < 2; ++which) {
        Asset grown = asset;
        std::vector<float>& steps = *steps_of(grown)[which];
        ASSERT_FALSE(steps.empty()) << which;
        steps.back() = std::nextafter(kMaxStep, 2.0f * kMaxStep);
        try {
            write_paim(directory_ / "x.paim", grown);
            ADD_FAILURE() << which;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
        }
        EXPECT_FALSE(std::filesystem::exists(directory_ / "x.paim")) << which;
    }
}

TEST_F(FiniteValues, OfComponentsTimesWeights) {
    Asset asset = make_example_asset();
    for (StoredValues& component : asset.moving().positions.components) {
        component = std::vector<float>(component.size(), 1e20f);
    }
    for (StoredValues& component : asset.moving().transfer->matrix.components) {
        component = std::vector<float>(component.size(), -1e20f);
    }
    grow(asset, [](Asset& a) -> std::vector<float>& { return a.moving().positions.weights; });
    grow(asset,
         [](Asset& a) -> std::vector<float>& { return a.moving().transfer->matrix.weights; });
}

// Half floats are rounded before they are read: to the next one, or beyond all of them.
TEST_F(FiniteValues, OfHalfFloats) {
    Asset asset = make_example_asset();
    LowRank& positions = asset.moving().positions;
    positions.precision = Precision::f16;
    // Rounded to 1, which is more by half a rounding of halves.
    const float nearly_one = 1.0f - 0x1p-13f;
    for (StoredValues& component : positions.components) {
        component = std::vector<float>(component.size(), 0.0f);
    }
    positions.components[0] = std::vector<float>(positions.num_rows(), nearly_one);
    positions.mean = std::vector<float>(positions.num_rows(), 0x1p127f);
    const auto is_written = [&](float weight) {
        positions.weights[0] = weight;
        return is_done([&] {
            write_paim(directory_ / "x.paim", asset);
            read_paim(directory_ / "x.paim");
        });
    };
    // Together with 2^127 this is the largest float.
    const float most = std::numeric_limits<float>::max() - 0x1p127f;
    EXPECT_TRUE(is_written(most));
    EXPECT_FALSE(is_written(0x1p127f));
    EXPECT_LT(0x1p127 + 0x1p127 * double{nearly_one}, double{std::numeric_limits<float>::max()});
    std::filesystem::remove(directory_ / "x.paim");
    EXPECT_FALSE(is_written(0x1p127f));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "x.paim"));
    positions.components[0] = std::vector<float>(positions.num_rows(), 65520.0f);
    EXPECT_FALSE(is_written(1e-3f));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "x.paim"));
}

TEST_F(FiniteValues, OfStillParts) {
    Asset asset = make_example_asset();
    CodedMesh still = asset.moving();
    still.positions = LowRank::still(3, std::vector<float>(12, 1.0f));
    still.transfer = SvdTransfer(LowRank::still(
        still.layout.num_planes(), std::vector<float>(4 * still.layout.num_planes(), 1.0f)));
    asset.parts.push_back(still);
    EXPECT_TRUE(is_done([&] { write_paim(directory_ / "x.paim", asset); }));
    std::filesystem::remove(directory_ / "x.paim");
    asset.still()->positions.mean = std::vector<float>(12, std::numeric_limits<float>::infinity());
    EXPECT_FALSE(is_done([&] { write_paim(directory_ / "x.paim", asset); }));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "x.paim"));
}

TEST_F(FiniteValues, OfBasesTimesScales) {
    Asset floats = make_clustered_example(2, 1, 2);
    LowRank& bases = floats.moving().transfer->matrix;
    bases.mean = std::vector<float>(bases.num_rows(), 1e6f);
    grow(floats, scales);
    Asset integers = make_clustered_example(2, 1, 2, true);
    for (float& step : integers.moving().transfer->matrix.steps) step = 1e6f;
    grow(integers, scales);
}

TEST_F(FiniteValues, OfCoefficientsTimesBases) {
    Asset asset = make_clustered_example(2, 1, 2);
    LowRank& bases = asset.moving().transfer->matrix;
    bases.mean = std::vector<float>(bases.num_rows(), 1e10f);
    const auto with_coefficient = [&](float coefficient) {
        Asset changed = asset;
        changed.moving().transfer.as<CpcaTransfer>()->clusters.coefficients[0] =
            std::vector<float>{coefficient, 0.0f, 0.0f, 0.0f};
        return changed;
    };
    write_paim(directory_ / "x.paim", with_coefficient(1.0f));
    EXPECT_TRUE(decodes_to_finite_numbers(read_paim(directory_ / "x.paim")));
    // Bytes may say that a coefficient is no number: it must not become one that is.
    for (const float coefficient : {1e30f, std::numeric_limits<float>::infinity()}) {
        write_unchecked(directory_ / "x.paim", with_coefficient(1.0f),
                        with_coefficient(coefficient));
        EXPECT_THROW(read_paim(directory_ / "x.paim"), Error);
        EXPECT_THROW(write_paim(directory_ / "x.paim", with_coefficient(coefficient)), Error);
    }
}

}  // namespace
}  // namespace paim
