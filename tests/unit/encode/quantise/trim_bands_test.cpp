// Bands that hold nothing go, and all else stays where it was.
#include "compressor/encode/quantise/trim_bands.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paim/codec/component_planes.h"
#include "tests/example_asset.h"

namespace paim {
namespace {

constexpr uint32_t kNumVertices = 4;

// Of one part.
void clear_band(CodedMesh& mesh, uint32_t band) {
    const auto clear = [&](StoredValues& values) {
        StoredValues::Values all = values.values();
        std::visit(
            [&](auto& numbers) {
                for (uint32_t channel = 0; channel < mesh.layout.channels; ++channel) {
                    for (uint32_t i = band * band; i < (band + 1) * (band + 1); ++i) {
                        const size_t first = mesh.layout.plane(channel, i) * kNumVertices;
                        std::fill_n(numbers.begin() + static_cast<ptrdiff_t>(first), kNumVertices,
                                    0);
                    }
                }
                values = numbers;
            },
            all);
    };
    LowRank& matrix = mesh.transfer->matrix;
    clear(matrix.mean);
    for (StoredValues& component : matrix.components) clear(component);
}

// Of all parts.
void clear_band(Asset& asset, uint32_t band) {
    for (CodedMesh& mesh : asset.parts) clear_band(mesh, band);
}

void expect_first_bands(const CodedMesh& trimmed, const CodedMesh& whole, uint32_t bands) {
    const LowRank& kept = trimmed.transfer->matrix;
    const LowRank& all = whole.transfer->matrix;
    ASSERT_EQ(trimmed.layout.in_bands, bands);
    EXPECT_EQ(trimmed.layout.channels, whole.layout.channels);
    EXPECT_EQ(kept.num_planes, trimmed.layout.num_planes());
    ASSERT_EQ(kept.mean.size(), kept.num_rows());
    ASSERT_EQ(kept.steps.size(), all.steps.empty() ? 0 : kept.num_planes);
    for (uint32_t channel = 0; channel < whole.layout.channels; ++channel) {
        for (uint32_t i = 0; i < bands * bands; ++i) {
            const uint32_t to = trimmed.layout.plane(channel, i);
            const uint32_t from = whole.layout.plane(channel, i);
            EXPECT_EQ(decode_plane(trimmed, Attribute::transfer, to),
                      decode_plane(whole, Attribute::transfer, from));
            for (size_t v = 0; v < kNumVertices; ++v) {
                EXPECT_EQ(kept.mean[to * kNumVertices + v], all.mean[from * kNumVertices + v]);
            }
            EXPECT_EQ(kept.step(to), all.step(from));
        }
    }
}

void expect_first_bands(const Asset& trimmed, const Asset& whole, uint32_t bands) {
    ASSERT_EQ(trimmed.parts.size(), whole.parts.size());
    for (size_t j = 0; j < whole.parts.size(); ++j) {
        expect_first_bands(trimmed.parts[j], whole.parts[j], bands);
    }
}

class TrimBands : public testing::TestWithParam<bool> {
  protected:
    Asset example() const {
        Asset asset = make_example_asset(4, 3);
        if (GetParam()) asset = quantise_example(asset);
        const TransferLayout layout = asset.moving().layout;
        asset.parts.push_back(GetParam() ? make_quantised_still(layout)
                                         : make_example_still(layout));
        return asset;
    }
};

TEST_P(TrimBands, TakesEmptyBandsFromTheTop) {
    for (uint32_t bands = 1; bands <= 4; ++bands) {
        Asset asset = example();
        for (uint32_t band = bands; band < 4; ++band) clear_band(asset, band);
        const Asset whole = asset;
        trim_bands(asset);
        expect_first_bands(asset, whole, bands);
    }
}

TEST_P(TrimBands, LeavesEmptyBandsBelowOthers) {
    Asset asset = example();
    clear_band(asset, 1);
    clear_band(asset, 3);
    const Asset whole = asset;
    trim_bands(asset);
    expect_first_bands(asset, whole, 3);
}

TEST_P(TrimBands, KeepsOneOfNothing) {
    Asset asset = example();
    for (uint32_t band = 0; band < 4; ++band) clear_band(asset, band);
    const Asset whole = asset;
    trim_bands(asset);
    expect_first_bands(asset, whole, 1);
}

// One value of the last plane of the last channel, in the last component.
TEST_P(TrimBands, SeesASingleValue) {
    Asset asset = example();
    clear_band(asset, 3);
    StoredValues& component = asset.moving().transfer->matrix.components.back();
    StoredValues::Values all = component.values();
    std::visit(
        [&](auto& numbers) {
            numbers.back() = 1;
            component = numbers;
        },
        all);
    trim_bands(asset);
    EXPECT_EQ(asset.moving().layout.in_bands, 4u);
}

// What one part has nothing of, another may show.
TEST_P(TrimBands, KeepsWhatStandsStillHas) {
    Asset asset = example();
    clear_band(asset.moving(), 3);
    const Asset whole = asset;
    trim_bands(asset);
    expect_first_bands(asset, whole, 4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TrimBands, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Integers" : "Floats"; });

// Bands of outgoing radiance go in the same way, and those of light stay.
TEST(TrimBands, TakesEmptyBandsOfOutgoingRadiance) {
    const TransferLayout layout{TransferKind::glossy, 3, 1, 4};
    for (uint32_t bands = 1; bands <= 4; ++bands) {
        Asset asset = make_example_asset(layout);
        LowRank& matrix = asset.moving().transfer->matrix;
        const auto clear = [&](StoredValues& values) {
            std::vector<float> kept = values.floats();
            for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
                if (layout.output_band(plane) < bands) continue;
                std::fill_n(kept.begin() + static_cast<ptrdiff_t>(plane * kNumVertices),
                            kNumVertices, 0.0f);
            }
            values = kept;
        };
        clear(matrix.mean);
        for (StoredValues& component : matrix.components) clear(component);
        const Asset whole = asset;
        trim_bands(asset);
        const TransferLayout trimmed = asset.moving().layout;
        EXPECT_EQ(trimmed.in_bands, 3u);
        ASSERT_EQ(trimmed.out_bands, bands);
        for (uint32_t o = 0; o < trimmed.num_outgoing(); ++o) {
            for (uint32_t i = 0; i < 9; ++i) {
                EXPECT_EQ(decode_plane(asset.moving(), Attribute::transfer, trimmed.plane(0, i, o)),
                          decode_plane(whole.moving(), Attribute::transfer, layout.plane(0, i, o)));
            }
        }
    }
}

TEST(TrimBands, TakesThemFromBasesOfClusters) {
    Asset asset = make_clustered_example(3);
    LowRank& matrix = asset.moving().transfer->matrix;
    const size_t rows = matrix.num_points;
    std::vector<float> mean = matrix.mean.floats();
    std::fill(mean.begin() + static_cast<ptrdiff_t>(4 * rows), mean.end(), 0.0f);
    matrix.mean = mean;
    for (StoredValues& component : matrix.components) {
        std::vector<float> values = component.floats();
        std::fill(values.begin() + static_cast<ptrdiff_t>(4 * rows), values.end(), 0.0f);
        component = values;
    }
    const Asset whole = asset;
    trim_bands(asset);
    ASSERT_EQ(asset.moving().layout.in_bands, 2u);
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(decode_plane(asset.moving(), Attribute::transfer, i),
                  decode_plane(whole.moving(), Attribute::transfer, i));
    }
}

}  // namespace
}  // namespace paim
