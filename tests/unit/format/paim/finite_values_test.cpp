// What a reader accepts decodes to finite numbers, whatever the pose and however much of it is
// used.
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
    // Whatever is read back has to decode to finite numbers, and what surely does not is refused.
    void grow(Asset asset, const std::function<std::vector<float>&(Asset&)>& numbers_of) {
        uint32_t num_read = 0, num_refused = 0;
        for (int exponent = 0; exponent <= 126; exponent += 3) {
            Asset grown = asset;
            for (float& number : numbers_of(grown)) {
                number = std::clamp(std::ldexp(number, exponent), -kMaxStep, kMaxStep);
            }
            write_paim(directory_ / "x.paim", grown);
            try {
                EXPECT_TRUE(decodes_to_finite_numbers(read_paim(directory_ / "x.paim")))
                    << "2^" << exponent;
                ++num_read;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
                ++num_refused;
            }
        }
        EXPECT_GT(num_read, 20u) << "ordinary numbers must be read";
        EXPECT_GT(num_refused, 0u) << "else this says nothing";
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
    VertexClusters& clusters = asset.moving().transfer.as<CpcaTransfer>()->clusters;
    clusters.coefficients[0] = std::vector<float>{1e30f, 0.0f, 0.0f, 0.0f};
    write_paim(directory_ / "x.paim", asset);
    EXPECT_THROW(read_paim(directory_ / "x.paim"), Error);
    // Bytes may say that a coefficient is no number: it must not become one that is.
    clusters.coefficients[0] = std::vector<float>{1.0f, 0.0f, 0.0f, 0.0f};
    write_paim(directory_ / "x.paim", asset);
    EXPECT_TRUE(decodes_to_finite_numbers(read_paim(directory_ / "x.paim")));
}

}  // namespace
}  // namespace paim
