// Assets of every codec against a bake, measured as whole planes and, slowly, pose by pose.
#include "paim/metrics/asset_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "analysis/bench/made_up_identity.h"
#include "paim/base/error.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/mesh/cache_order.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kVertices = 4;

class AssetErrorTest : public testing::Test {
  protected:
    // A bake for the asset's meshes: poses 0 … num_poses − 1, then the still meshes.
    BakeReader write_bake(const Asset& asset, const TransferLayout& layout, uint32_t num_poses,
                          const std::function<BakedPose()>& make_pose) {
        std::vector<BakeIdentity::Source> poses;
        for (uint32_t p = 0; p < num_poses; ++p) poses.push_back({"pose", p});
        const CodedMesh& moving = asset.moving();
        BakeIdentity identity =
            made_up_identity(moving.topology, moving.albedo, layout, std::move(poses));
        const auto directory = directory_ / "x.bake";
        std::filesystem::remove_all(directory);
        if (asset.still() != nullptr) identity.still_meshes.push_back({"still", 0});
        const BakeWriter writer(directory, identity, moving.topology, moving.albedo);
        for (uint32_t p = 0; p < num_poses; ++p) writer.write_pose(p, make_pose());
        if (asset.still() != nullptr) {
            writer.write_still_mesh({asset.still()->topology, asset.still()->albedo, make_pose()});
        }
        return BakeReader(directory);
    }

    // The same of random numbers.
    BakeReader write_bake(const Asset& asset, const TransferLayout& layout, uint32_t num_poses) {
        RandomStream random(5);
        const auto fill = [&](size_t count, double size) {
            std::vector<float> values(count);
            for (float& value : values) {
                value = static_cast<float>(size * (2.0 * random.uniform() - 1.0));
            }
            return values;
        };
        const auto random_pose = [&] {
            BakedPose pose;
            pose.positions = fill(3 * kVertices, 2.0);
            pose.normals = fill(3 * kVertices, 1.0);
            pose.transfer = fill(layout.num_planes() * kVertices, 2.0);
            pose.noise = fill(layout.num_planes() * kVertices, 0.1);
            pose.statistics.transfer_rms.assign(layout.in_bands, 1.0);
            pose.statistics.noise_rms.assign(layout.in_bands, 0.1);
            return pose;
        };
        return write_bake(asset, layout, num_poses, random_pose);
    }

    // What differs, by the player's decoder: Σ w (t̂ − y)² / Σ w y², and the same of positions.
    static void expect_as_pose_by_pose(const Asset& asset, const BakeReader& bake,
                                       const BandPower& spectrum) {
        const TransferLayout& layout = bake.identity().layout;
        MeshDecoder decoder(asset.moving());
        DecodedPose decoded;
        double deviation = 0.0, baked = 0.0, noise = 0.0, distances = 0.0;
        for (uint32_t p = 0; p < bake.num_poses(); ++p) {
            decoder.decode(p, {}, decoded);
            const BakedPose pose = bake.read_pose(p);
            for (uint32_t channel = 0; channel < layout.channels; ++channel) {
                for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
                    const double weight =
                        spectrum.weight(static_cast<uint32_t>(sh::band_of(static_cast<int>(i))));
                    for (uint32_t v = 0; v < kVertices; ++v) {
                        const double d = pose.noise[layout.plane(channel, i) * kVertices + v];
                        const double y = pose.transfer[layout.plane(channel, i) * kVertices + v];
                        double t = 0.0;
                        if (i < decoded.layout.num_coefficients()) {
                            const uint32_t c = decoded.layout.channels == 1 ? 0 : channel;
                            t = decoded.transfer[decoded.layout.plane(c, i) * kVertices + v];
                        }
                        deviation += weight * (t - y) * (t - y);
                        baked += weight * y * y;
                        noise += weight * d * d;
                    }
                }
            }
            for (size_t j = 0; j < pose.positions.size(); ++j) {
                const double d = static_cast<double>(decoded.positions[j]) - pose.positions[j];
                distances += d * d;
            }
        }
        const AssetError error = measure_asset(asset, bake, spectrum);
        // The sum of a few products of about 1 in floats is rounded by some 2^-24, in two orders,
        // while what is measured is about 1.
        EXPECT_NEAR(error.transfer.error_to_bake, std::sqrt(deviation / baked), 1e-6);
        EXPECT_NEAR(error.transfer.bake_noise, std::sqrt(noise / baked), 1e-14);
        EXPECT_NEAR(error.geometry.rms(), std::sqrt(distances / kVertices / bake.num_poses()),
                    1e-6);
        EXPECT_GT(error.transfer.error_to_bake, 0.1);
        EXPECT_EQ(error.transfer.bands.size(), layout.in_bands);
    }

    void expect_failure(const Asset& asset, const BakeReader& bake, const std::string& part) {
        try {
            measure_asset(asset, bake, BandPower::natural());
            FAIL() << part;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find("x.bake: "), std::string::npos);
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }

    TemporaryDirectory directory_;
};

TEST_F(AssetErrorTest, IsThatOfThePlayersDecoder) {
    const BandPower natural = BandPower::natural();
    for (const uint32_t channels : {1u, 3u}) {
        const Asset plain = make_example_asset(2, channels);
        const BakeReader bake = write_bake(plain, plain.moving().layout, plain.num_poses());
        for (const Asset& asset :
             {plain, quantise_example(plain), make_clustered_example(2, channels, 2),
              make_clustered_example(2, channels, 1, true)}) {
            expect_as_pose_by_pose(asset, bake, natural);
        }
    }
}

TEST_F(AssetErrorTest, CountsBandsAndChannelsThatTheAssetLacks) {
    const Asset asset = make_example_asset(2, 1);
    const BakeReader bake = write_bake(asset, {TransferKind::diffuse, 3, 3}, asset.num_poses());
    expect_as_pose_by_pose(asset, bake, BandPower::flat(3));
    expect_as_pose_by_pose(make_example_asset(1, 3), bake, BandPower::flat(3));
}

TEST_F(AssetErrorTest, RefusesAnotherAnimation) {
    const Asset asset = make_example_asset(2, 1);
    expect_failure(asset, write_bake(asset, asset.moving().layout, 4), "4 poses, got 5");
    const BakeReader bake = write_bake(asset, asset.moving().layout, 5);
    expect_failure(make_example_asset(3, 1), bake, "2 bands and 1 channels at most, got 3 and 1");
    expect_failure(make_example_asset(2, 3), bake, "2 bands and 1 channels at most, got 2 and 3");
    Asset turned = asset;
    std::swap(turned.moving().topology.triangles[0], turned.moving().topology.triangles[1]);
    expect_failure(turned, bake, "other triangles");
}

// Integers of a still part against its bake: Σ (x̂ − x)² / Σ x² of its own values, and distances.
TEST_F(AssetErrorTest, MeasuresWhatStandsStill) {
    for (const uint32_t bands : {2u, 3u}) {
        Asset asset = make_example_asset(bands, 3);
        asset.parts.push_back(make_quantised_still(asset.moving().layout));
        const CodedMesh& still = *asset.still();
        const BakeReader bake = write_bake(asset, {TransferKind::diffuse, 3, 3}, 5);
        const BakedPose& baked = bake.still_mesh()->pose;
        const std::vector<float> positions = still.positions.mean_floats();
        const std::vector<float> transfer = still.transfer->matrix.mean_floats();
        double deviation = 0.0, energy = 0.0, distances = 0.0;
        for (uint32_t channel = 0; channel < 3; ++channel) {
            for (uint32_t i = 0; i < 9; ++i) {
                for (uint32_t v = 0; v < 4; ++v) {
                    const double y = baked.transfer[(channel * 9 + i) * 4 + v];
                    const double t =
                        i < bands * bands ? transfer[still.layout.plane(channel, i) * 4 + v] : 0.0f;
                    deviation += (t - y) * (t - y);
                    energy += y * y;
                }
            }
        }
        for (size_t j = 0; j < positions.size(); ++j) {
            const double d = static_cast<double>(positions[j]) - baked.positions[j];
            distances += d * d;
        }
        const AssetError error = measure_asset(asset, bake, BandPower::flat(3));
        ASSERT_TRUE(error.still.has_value());
        EXPECT_NEAR(error.still->transfer.error_to_bake, std::sqrt(deviation / energy), 1e-12);
        EXPECT_NEAR(error.still->geometry.rms(), std::sqrt(distances / 4.0), 1e-12);
        const std::vector<NamedError> named = named_errors(error);
        EXPECT_EQ(named.back().name, "scenery_position_worst");
        EXPECT_EQ(named.back().value, error.still->geometry.worst());
    }
}

// One vertex is decoded as it was baked, with all of its noise; the others are decoded as nothing.
// Where the noise is all that vertex's own, what is decoded adds it, and where it is another's,
// what is decoded has none of it: E‖t̂ − t‖² = ‖t̂ − y‖² ± ‖d‖². Files have vertices in another
// order.
TEST_F(AssetErrorTest, TakesNoiseInTheOrderOfTheFile) {
    const TransferLayout layout{TransferKind::diffuse, 1, 1};
    const Asset as_baked = make_example_asset(1, 1, 2, 1);
    const CacheOrder order = cache_order(as_baked.moving().topology);
    ASSERT_NE(order.old_vertex, (std::vector<uint32_t>{0, 1, 2, 3}));
    for (uint32_t noisy = 0; noisy < kVertices; ++noisy) {
        float sign = 1.0f;
        const BakeReader bake = write_bake(as_baked, layout, 2, [&] {
            BakedPose pose;
            pose.positions.assign(3 * kVertices, 0.5f);
            pose.normals.assign(3 * kVertices, 0.0f);
            pose.transfer.assign(kVertices, 2.0f + sign);  // 3, then 1
            pose.noise.assign(kVertices, 0.0f);
            pose.noise[noisy] = sign;
            pose.statistics.transfer_rms = {1.0};
            pose.statistics.noise_rms = {1.0};
            sign = -sign;
            return pose;
        });
        for (uint32_t decoded = 0; decoded < kVertices; ++decoded) {
            Asset asset = as_baked;
            asset.vertex_order = VertexOrder::cache;
            asset.moving().topology = order.topology;
            std::vector<float> mean(kVertices, 0.0f), component(kVertices, 0.0f);
            for (size_t v = 0; v < kVertices; ++v) {
                if (order.old_vertex[v] != decoded) continue;
                mean[v] = 2.0f;
                component[v] = 1.0f;
            }
            LowRank& matrix = asset.moving().transfer->matrix;
            matrix.mean = mean;
            matrix.components = {component};
            matrix.weights = {1.0f, -1.0f};
            const TransferError error = measure_asset(asset, bake, BandPower::flat(1)).transfer;
            // ‖y‖² = 4 (3² + 1²), of which three vertices are lost; ‖d‖² = 2. Roundings of a few
            // numbers.
            EXPECT_NEAR(error.error_to_bake, std::sqrt(30.0 / 40.0), 1e-14);
            EXPECT_NEAR(error.bake_noise, std::sqrt(2.0 / 40.0), 1e-14);
            // Noise along the decoder's span is found with floats.
            EXPECT_NEAR(error.error, std::sqrt((decoded == noisy ? 32.0 : 28.0) / 40.0), 1e-7)
                << decoded << " " << noisy;
        }
    }
}

// Vertices in the order that files of integers have are those of the bake.
TEST_F(AssetErrorTest, FindsWhatStandsStillInCacheOrder) {
    Asset asset = make_example_asset(2, 1);
    asset.parts.push_back(make_example_still(asset.moving().layout));
    // Vertex 3 belongs to no triangle and would come last.
    asset.still()->topology.triangles = {{3, 1, 2}};
    const BakeReader bake = write_bake(asset, asset.moving().layout, 5);
    const CacheOrder still = cache_order(asset.still()->topology);
    ASSERT_NE(still.old_vertex, (std::vector<uint32_t>{0, 1, 2, 3}));
    asset.vertex_order = VertexOrder::cache;
    asset.moving().topology = cache_order(asset.moving().topology).topology;
    asset.still()->topology = still.topology;
    std::vector<float> positions(12), transfer(16);
    for (size_t v = 0; v < 4; ++v) {
        const size_t old = still.old_vertex[v];
        for (size_t j = 0; j < 3; ++j) {
            positions[4 * j + v] = bake.still_mesh()->pose.positions[4 * j + old];
        }
        for (size_t j = 0; j < 4; ++j) {
            transfer[4 * j + v] = bake.still_mesh()->pose.transfer[4 * j + old];
        }
    }
    asset.still()->positions = LowRank::still(3, positions);
    asset.still()->transfer->matrix = LowRank::still(4, transfer);
    const AssetError error = measure_asset(asset, bake, BandPower::natural());
    EXPECT_EQ(error.still->geometry.worst(), 0.0);
    EXPECT_EQ(error.still->transfer.error_to_bake, 0.0);
    EXPECT_NEAR(error.still->transfer.error, error.still->transfer.bake_noise, 1e-12);
}

// Whatever a vertex of no face errs, and however many there are, every figure is that of the mesh
// without them. One lies before the tetrahedron's vertices, two behind.
TEST_F(AssetErrorTest, DoesNotCountVerticesOfNoFace) {
    const TransferLayout layout{TransferKind::diffuse, 2, 1};
    const auto spread = [&](const std::vector<float>& planes, float isolated) {
        std::vector<float> wider;
        for (size_t plane = 0; plane < planes.size() / kVertices; ++plane) {
            wider.push_back(isolated);
            for (size_t v = 0; v < kVertices; ++v) wider.push_back(planes[kVertices * plane + v]);
            wider.insert(wider.end(), {2.0f * isolated, -isolated});
        }
        return wider;
    };
    const auto make_pose = [&](uint64_t seed) {
        RandomStream random(seed);
        BakedPose pose;
        for (auto* const values : {&pose.positions, &pose.normals, &pose.transfer, &pose.noise}) {
            const bool of_transfer = values == &pose.transfer || values == &pose.noise;
            values->resize((of_transfer ? 4 : 3) * kVertices);
            for (float& value : *values) value = static_cast<float>(random.uniform());
        }
        pose.statistics.transfer_rms = pose.statistics.noise_rms = {1.0, 1.0};
        return pose;
    };
    const Asset asset = make_example_asset(2, 1);
    uint64_t seed = 0;
    const AssetError expected =
        measure_asset(asset, write_bake(asset, layout, 5, [&] { return make_pose(++seed); }),
                      BandPower::natural());

    Asset wider = asset;
    CodedMesh& mesh = wider.moving();
    mesh.topology.num_vertices = kVertices + 3;
    for (Triangle& triangle : mesh.topology.triangles) {
        for (uint32_t& v : triangle) ++v;
    }
    for (LowRank* const matrix : {&mesh.positions, &mesh.transfer->matrix}) {
        matrix->num_points = kVertices + 3;
        matrix->mean = spread(matrix->mean.floats(), 40.0f);
        for (StoredValues& component : matrix->components) {
            component = spread(component.floats(), -3.0f);
        }
    }
    seed = 0;
    const auto make_wider_pose = [&] {
        BakedPose pose = make_pose(++seed);
        for (auto* const values : {&pose.positions, &pose.normals, &pose.transfer, &pose.noise}) {
            *values = spread(*values, static_cast<float>(seed));
        }
        return pose;
    };
    const AssetError error =
        measure_asset(wider, write_bake(wider, layout, 5, make_wider_pose), BandPower::natural());
    const std::vector<NamedError> named = named_errors(error);
    for (const NamedError& one : named_errors(expected)) {
        const auto found = std::find_if(named.begin(), named.end(), [&](const NamedError& other) {
            return other.name == one.name;
        });
        EXPECT_EQ(found->value, one.value) << one.name;
    }
    EXPECT_EQ(error.geometry.diagonal, expected.geometry.diagonal);
    // The numbers are those of the file.
    EXPECT_EQ(error.geometry.distance.worst_vertex, expected.geometry.distance.worst_vertex + 1);
    EXPECT_EQ(error.transfer.worst_vertex, expected.transfer.worst_vertex + 1);
}

TEST_F(AssetErrorTest, RefusesOtherThingsThatStandStill) {
    Asset asset = make_example_asset(2, 1);
    const BakeReader without = write_bake(asset, asset.moving().layout, 5);
    asset.parts.push_back(make_example_still(asset.moving().layout));
    expect_failure(asset, without, "0 vertices of still meshes, got 4");
    const BakeReader bake = write_bake(asset, asset.moving().layout, 5);
    std::swap(asset.still()->topology.triangles[0], asset.still()->topology.triangles[1]);
    expect_failure(asset, bake, "other triangles of the still meshes");
}

// Every figure by its own name.
TEST_F(AssetErrorTest, IsStatedAndReadBack) {
    AssetError error;
    error.transfer.error = 0.3;
    error.transfer.missing_bands = 0.4;
    error.transfer.error_to_bake = 0.25;
    error.transfer.worst_vertex_error_to_bake = 0.75;
    error.transfer.worst_pose_error_to_bake = 0.625;
    error.geometry.add(std::vector<float>{0, 0, 0, 0, 0, 0}, std::vector<float>{3, 0, 4, 0, 0, 0},
                       0);
    error.shape.whole = {0.03, 0.04, 2.5};
    error.shape.worst = {0.3, 0.4, 12.5};
    Asset asset = make_example_asset();
    asset.provenance_json =
        R"({"measured":)" + error_statement_json(error, BandPower::natural()) + "}";
    const ErrorStatement statement = read_error_statement(asset, "x.paim");
    EXPECT_EQ(statement.band_power, "natural");
    // One of two vertices is off by the diagonal, 5.
    const std::vector<std::pair<std::string, double>> expected{
        {"transfer_error", 0.3},
        {"transfer_missing_bands", 0.4},
        {"transfer_total_error", std::hypot(0.3, 0.4)},
        {"transfer_deviation", 0.25},
        {"transfer_worst_vertex_deviation", 0.75},
        {"transfer_worst_pose_deviation", 0.625},
        {"position_rms", std::sqrt(12.5)},
        {"position_worst", 5.0},
        {"position_relative_rms", std::sqrt(0.5)},
        {"position_relative_worst", 1.0},
        {"kg_error", 100.0 * std::sqrt(25.0 / 12.5)},
        {"e_rms", 1000.0 * 5.0 / std::sqrt(6.0) * 2.0 / 5.0},
        {"sted", 0.05},
        {"sted_worst_piece", 0.5},
        {"normal_angle_deg", 2.5},
        {"normal_angle_deg_worst_piece", 12.5}};
    ASSERT_EQ(statement.errors.size(), expected.size());
    for (size_t j = 0; j < expected.size(); ++j) {
        EXPECT_EQ(statement.errors[j].name, expected[j].first);
        // A few roundings.
        EXPECT_NEAR(statement.errors[j].value / expected[j].second, 1.0, 1e-14)
            << expected[j].first;
    }
}

}  // namespace
}  // namespace paim
