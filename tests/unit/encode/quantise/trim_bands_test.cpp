// Bands that hold nothing go, and all else stays where it was.
#include "compressor/encode/quantise/trim_bands.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paim/codec/component_planes.h"
#include "tests/example_model.h"

namespace paim {
namespace {

constexpr uint32_t kVertices = 4;

void clear_band(Asset& model, uint32_t band) {
    const auto clear = [&](StoredValues& values) {
        StoredValues::Values all = values.values();
        std::visit(
            [&](auto& numbers) {
                for (uint32_t channel = 0; channel < model.moving().layout.channels; ++channel) {
                    for (uint32_t i = band * band; i < (band + 1) * (band + 1); ++i) {
                        const size_t first = model.moving().layout.plane(channel, i) * kVertices;
                        std::fill_n(numbers.begin() + static_cast<ptrdiff_t>(first), kVertices, 0);
                    }
                }
                values = numbers;
            },
            all);
    };
    clear(model.moving().transfer->matrix.mean);
    for (StoredValues& component : model.moving().transfer->matrix.components) clear(component);
    clear(model.scenery.transfer.values);
}

void expect_first_bands(const Asset& trimmed, const Asset& whole, uint32_t bands) {
    ASSERT_EQ(trimmed.moving().layout.in_bands, bands);
    EXPECT_EQ(trimmed.moving().layout.channels, whole.moving().layout.channels);
    EXPECT_EQ(trimmed.moving().transfer->matrix.num_planes, trimmed.moving().layout.num_planes());
    EXPECT_EQ(trimmed.moving().transfer->matrix.mean.size(), trimmed.moving().transfer->matrix.num_rows());
    for (uint32_t channel = 0; channel < whole.moving().layout.channels; ++channel) {
        for (uint32_t i = 0; i < bands * bands; ++i) {
            const uint32_t to = trimmed.moving().layout.plane(channel, i);
            const uint32_t from = whole.moving().layout.plane(channel, i);
            EXPECT_EQ(decode_plane(trimmed, Attribute::transfer, to),
                      decode_plane(whole, Attribute::transfer, from));
            for (size_t v = 0; v < 4; ++v) {
                EXPECT_EQ(trimmed.scenery.transfer.values[to * 4 + v],
                          whole.scenery.transfer.values[from * 4 + v]);
            }
        }
    }
    EXPECT_EQ(trimmed.scenery.transfer.values.size(), size_t{4} * trimmed.moving().layout.num_planes());
    const std::vector<float> steps = whole.scenery.transfer.steps;
    ASSERT_EQ(trimmed.scenery.transfer.steps.empty(), steps.empty());
    if (steps.empty()) return;
    for (uint32_t i = 0; i < bands * bands; ++i) {
        EXPECT_EQ(trimmed.scenery.transfer.steps[trimmed.moving().layout.plane(2, i)],
                  steps[whole.moving().layout.plane(2, i)]);
    }
}

class TrimBands : public testing::TestWithParam<bool> {
  protected:
    Asset example() const {
        Asset model = make_example_model(4, 3);
        if (GetParam()) model = quantise_example(model);
        model.scenery =
            GetParam() ? make_quantised_scenery(model.moving().layout) : make_example_scenery(model.moving().layout);
        return model;
    }
};

TEST_P(TrimBands, TakesEmptyBandsFromTheTop) {
    for (uint32_t bands = 1; bands <= 4; ++bands) {
        Asset model = example();
        for (uint32_t band = bands; band < 4; ++band) clear_band(model, band);
        const Asset whole = model;
        trim_bands(model);
        expect_first_bands(model, whole, bands);
    }
}

TEST_P(TrimBands, LeavesEmptyBandsBelowOthers) {
    Asset model = example();
    clear_band(model, 1);
    clear_band(model, 3);
    const Asset whole = model;
    trim_bands(model);
    expect_first_bands(model, whole, 3);
}

TEST_P(TrimBands, KeepsOneOfNothing) {
    Asset model = example();
    for (uint32_t band = 0; band < 4; ++band) clear_band(model, band);
    const Asset whole = model;
    trim_bands(model);
    expect_first_bands(model, whole, 1);
}

// One value of the last plane of the last channel, in the last component.
TEST_P(TrimBands, SeesASingleValue) {
    Asset model = example();
    clear_band(model, 3);
    StoredValues::Values all = model.moving().transfer->matrix.components.back().values();
    std::visit(
        [&](auto& numbers) {
            numbers.back() = 1;
            model.moving().transfer->matrix.components.back() = numbers;
        },
        all);
    trim_bands(model);
    EXPECT_EQ(model.moving().layout.in_bands, 4u);
}

// What the animation has nothing of, the scenery beside it may show.
TEST_P(TrimBands, KeepsWhatTheSceneryHas) {
    Asset model = example();
    const StillPlanes shown = model.scenery.transfer;
    clear_band(model, 3);
    model.scenery.transfer = shown;
    const Asset whole = model;
    trim_bands(model);
    expect_first_bands(model, whole, 4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TrimBands, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Integers" : "Floats"; });

TEST(TrimBands, TakesThemFromBasesOfClusters) {
    Asset model = make_clustered_example(3);
    const size_t rows = model.moving().transfer->matrix.num_points;
    std::vector<float> mean = model.moving().transfer->matrix.mean.floats();
    std::fill(mean.begin() + static_cast<ptrdiff_t>(4 * rows), mean.end(), 0.0f);
    model.moving().transfer->matrix.mean = mean;
    for (StoredValues& component : model.moving().transfer->matrix.components) {
        std::vector<float> values = component.floats();
        std::fill(values.begin() + static_cast<ptrdiff_t>(4 * rows), values.end(), 0.0f);
        component = values;
    }
    const Asset whole = model;
    trim_bands(model);
    ASSERT_EQ(model.moving().layout.in_bands, 2u);
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(decode_plane(model, Attribute::transfer, i),
                  decode_plane(whole, Attribute::transfer, i));
    }
}

}  // namespace
}  // namespace paim
