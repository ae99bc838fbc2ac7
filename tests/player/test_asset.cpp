// A bending sphere.
#include "tests/player/test_asset.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/seed.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/svd/svd_transfer.h"
#include "paim/mesh/planes.h"
#include "paim/shade/shade.h"

namespace paim::player {

namespace {

// Vertices ring by ring from pole to pole; poles are rings of coinciding vertices, whose triangles
// have no area.
Topology sphere_topology(uint32_t num_rings, uint32_t num_segments) {
    Topology topology;
    topology.num_vertices = (num_rings + 1) * num_segments;
    for (uint32_t ring = 0; ring < num_rings; ++ring) {
        for (uint32_t s = 0; s < num_segments; ++s) {
            const uint32_t next = (s + 1) % num_segments;
            const uint32_t a = ring * num_segments + s, b = ring * num_segments + next;
            const uint32_t c = a + num_segments, d = b + num_segments;
            topology.triangles.push_back({a, c, b});
            topology.triangles.push_back({b, c, d});
        }
    }
    return topology;
}

std::vector<Vec3f> sphere_positions(uint32_t num_rings, uint32_t num_segments) {
    std::vector<Vec3f> positions;
    for (uint32_t ring = 0; ring <= num_rings; ++ring) {
        const double theta = kPi * ring / num_rings;
        for (uint32_t s = 0; s < num_segments; ++s) {
            const double phi = 2.0 * kPi * s / num_segments;
            positions.push_back(Vec3d(std::sin(theta) * std::sin(phi), std::cos(theta),
                                      std::sin(theta) * std::cos(phi))
                                    .cast<float>());
        }
    }
    return positions;
}

// One plane of a component: a low-frequency wave over space, about 1 high.
class Wave {
  public:
    explicit Wave(RandomStream& random)
        : direction_(2.0 * random.uniform() - 1.0, 2.0 * random.uniform() - 1.0,
                     2.0 * random.uniform() - 1.0),
          phase_(2.0 * kPi * random.uniform()) {}
    double at(const Vec3f& position) const {
        return std::sin(2.0 * direction_.dot(position.cast<double>()) + phase_);
    }

  private:
    Vec3d direction_;
    double phase_;
};

Precision precision_of(const std::vector<Precision>& precisions, uint32_t k, Precision otherwise) {
    return precisions.empty() ? otherwise : precisions[std::min<size_t>(k, precisions.size() - 1)];
}

// What the largest of some values of about 1 is stored as.
float scale_of(Precision precision) {
    return precision == Precision::i8 ? 120.0f : precision == Precision::i16 ? 3000.0f : 1.0f;
}

// The values times what scale_of() says, rounded to what the precision holds.
StoredValues store(const std::vector<float>& values, Precision precision) {
    const float scale = scale_of(precision);
    const auto convert = [&](auto zero) {
        std::vector<decltype(zero)> integers;
        for (const float value : values) {
            integers.push_back(static_cast<decltype(zero)>(std::lround(scale * value)));
        }
        return integers;
    };
    if (precision == Precision::i8) return convert(int8_t{0});
    if (precision == Precision::i16) return convert(int16_t{0});
    std::vector<float> floats = values;
    if (precision == Precision::f16) {
        for (float& value : floats) value = static_cast<float>(Eigen::half(value));
    }
    return floats;
}

// A wave over the sphere for every plane.
std::vector<float> waves(const std::vector<Vec3f>& positions, uint32_t num_planes, float scale,
                         RandomStream& random) {
    std::vector<float> values;
    for (uint32_t plane = 0; plane < num_planes; ++plane) {
        const Wave wave(random);
        for (const Vec3f& position : positions) {
            values.push_back(scale * static_cast<float>(wave.at(position)));
        }
    }
    return values;
}

// Stores a matrix as the options say.
// mean, components  [planes][points], components of about 1
// weight_scale      of what components add to the mean
LowRank make_matrix(const std::vector<float>& mean,
                    const std::vector<std::vector<float>>& components, uint32_t num_planes,
                    double weight_scale, const TestAssetOptions& options, RandomStream& random) {
    LowRank matrix;
    matrix.num_planes = num_planes;
    matrix.num_points = static_cast<uint32_t>(mean.size() / num_planes);
    matrix.num_poses = options.num_poses;
    matrix.num_components = static_cast<uint32_t>(components.size());
    matrix.precision = options.precision;
    matrix.singular_values.assign(components.size(), 1.0);
    float first_step = 1.0f;
    if (is_integer(options.precision)) {
        float largest = 0.0f;
        for (const float value : mean) largest = std::max(largest, std::abs(value));
        first_step = largest / scale_of(options.precision);
        std::vector<float> in_steps = mean;
        for (uint32_t plane = 0; plane < num_planes; ++plane) {
            const float relative = 1.0f + 0.1f * static_cast<float>(plane % 5);
            matrix.steps.push_back(relative * first_step);
            for (uint32_t n = 0; n < matrix.num_points; ++n) {
                in_steps[size_t{plane} * matrix.num_points + n] /= relative * largest;
            }
        }
        matrix.mean = store(in_steps, options.precision);
    } else {
        matrix.mean = mean;
    }
    for (uint32_t k = 0; k < components.size(); ++k) {
        const Precision precision =
            precision_of(options.component_precisions, k, options.precision);
        matrix.components.push_back(store(components[k], precision));
        for (uint32_t p = 0; p < options.num_poses; ++p) {
            matrix.weights.push_back(static_cast<float>(weight_scale * (random.uniform() - 0.5)) /
                                     (first_step * scale_of(precision)));
        }
    }
    return matrix;
}

LowRank make_geometry(const std::vector<Vec3f>& positions, const TestAssetOptions& options) {
    RandomStream random(stream_key(1, 3, options.geometry_components));
    std::vector<std::vector<float>> components;
    for (uint32_t k = 0; k < options.geometry_components; ++k) {
        components.push_back(waves(positions, 3, 1.0f, random));
    }
    return make_matrix(to_planes(positions), components, 3, 0.2, options, random);
}

LowRank make_transfer(const std::vector<Vec3f>& positions, const TransferLayout& layout,
                      const TestAssetOptions& options) {
    RandomStream random(stream_key(2, layout.num_planes(), options.transfer_components));
    std::vector<float> mean = waves(positions, layout.num_planes(), 0.3f, random);
    // The constant coefficient of each channel keeps radiance away from zero.
    for (uint32_t channel = 0; channel < options.channels; ++channel) {
        float* plane = mean.data() + layout.plane(channel, 0) * positions.size();
        for (size_t v = 0; v < positions.size(); ++v) plane[v] += 2.0f;
    }
    std::vector<std::vector<float>> components;
    for (uint32_t k = 0; k < options.transfer_components; ++k) {
        components.push_back(waves(positions, layout.num_planes(), 1.0f, random));
    }
    return make_matrix(mean, components, layout.num_planes(), 0.3, options, random);
}

CpcaTransfer make_clusters(const std::vector<Vec3f>& positions, const TransferLayout& layout,
                           const TestAssetOptions& options) {
    RandomStream random(stream_key(5, options.num_clusters, options.cluster_components));
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    VertexClusters clusters;
    clusters.num_clusters = options.num_clusters;
    clusters.num_components = options.cluster_components;
    for (size_t v = 0; v < positions.size(); ++v) {
        clusters.cluster.push_back(static_cast<uint32_t>(random.uniform() * options.num_clusters));
    }
    std::vector<float> row_scales{1.0f};
    for (uint32_t j = 0; j < options.cluster_components; ++j) {
        const Precision precision = precision_of(options.coefficient_precisions, j, Precision::f32);
        clusters.coefficients.push_back(store(waves(positions, 1, 1.0f, random), precision));
        row_scales.push_back(0.3f / scale_of(precision));
    }
    const uint32_t num_planes = layout.num_planes();
    std::vector<float> mean(size_t{num_planes} * clusters.num_rows());
    std::generate(mean.begin(), mean.end(), number);
    for (uint32_t r = 0; r < clusters.num_rows(); ++r) {
        const uint32_t row = r % clusters.rows_per_cluster();
        clusters.scales.push_back((1.0f + 0.2f * number()) * row_scales[row]);
        if (row != 0) continue;
        for (uint32_t plane = 0; plane < num_planes; ++plane) {
            float& value = mean[size_t{plane} * clusters.num_rows() + r];
            value = plane % layout.num_coefficients() == 0 ? 2.0f : 0.3f * value;
        }
    }
    std::vector<std::vector<float>> components(options.transfer_components);
    for (std::vector<float>& component : components) {
        component.resize(mean.size());
        std::generate(component.begin(), component.end(), number);
    }
    return {make_matrix(mean, components, num_planes, 0.3, options, random), std::move(clusters)};
}

}  // namespace

Asset make_test_asset(const TestAssetOptions& options) {
    const uint32_t num_segments = 2 * options.num_rings;
    const std::vector<Vec3f> positions = sphere_positions(options.num_rings, num_segments);
    Asset asset;
    asset.name = "test";
    CodedMesh& mesh = asset.moving();
    mesh.topology = sphere_topology(options.num_rings, num_segments);
    mesh.layout.in_bands = options.bands;
    mesh.layout.channels = options.channels;
    mesh.positions = make_geometry(positions, options);
    if (options.num_clusters == 0) {
        mesh.transfer = SvdTransfer(make_transfer(positions, mesh.layout, options));
    } else {
        mesh.transfer = make_clusters(positions, mesh.layout, options);
    }
    if (options.albedo_per_vertex) {
        RandomStream random(stream_key(3, 0, 0));
        mesh.albedo.values.clear();
        const Wave red(random), green(random), blue(random);
        for (const Vec3f& p : positions) {
            mesh.albedo.values.push_back(
                Vec3d(0.5 + 0.4 * red.at(p), 0.5 + 0.4 * green.at(p), 0.5 + 0.4 * blue.at(p))
                    .cast<float>());
        }
    } else {
        mesh.albedo.values = {Vec3f(0.9f, 0.6f, 0.3f)};
    }
    return asset;
}

CodedMesh stand_still(const CodedMesh& mesh, float offset) {
    CodedMesh still;
    still.topology = mesh.topology;
    still.albedo = mesh.albedo;
    still.layout = mesh.layout;
    std::vector<float> positions = mesh.positions.mean_floats();
    for (size_t v = 0; v < mesh.topology.num_vertices; ++v) positions[v] += offset;
    still.positions = LowRank::still(3, std::move(positions));
    still.transfer =
        SvdTransfer(LowRank::still(mesh.layout.num_planes(), mesh.transfer->matrix.mean_floats()));
    return still;
}

void scale_asset(Asset& asset, int exponent) {
    const auto scale = [&](std::vector<float>& values) {
        for (float& value : values) value = std::ldexp(value, exponent);
    };
    const auto scale_values = [&](StoredValues& values) {
        if (!values.holds_floats()) return;
        std::vector<float> floats = values.floats();
        scale(floats);
        values = StoredValues(std::move(floats));
    };
    for (CodedMesh& part : asset.parts) {
        LowRank& positions = part.positions;
        scale(positions.steps);
        if (!positions.steps.empty()) continue;
        scale_values(positions.mean);
        scale(positions.weights);
    }
    asset.origin *= std::ldexp(1.0, exponent);
}

LightCoefficients make_test_light(int bands) {
    RandomStream random(stream_key(4, 0, 0));
    LightCoefficients light;
    light.bands = bands;
    for (int i = 0; i < bands * bands; ++i) {
        const double scale = i == 0 ? 0.0 : 0.3 / std::sqrt(i);
        light.values.push_back(Vec3f(static_cast<float>(scale * (random.uniform() - 0.5)),
                                     static_cast<float>(scale * (random.uniform() - 0.5)),
                                     static_cast<float>(scale * (random.uniform() - 0.5))));
    }
    light.values[0] = Vec3f(0.6f, 0.5f, 0.4f);
    return light;
}

void light_frame(Frame& frame, const EnvironmentLight& environment, int bands, double angle_rad) {
    frame.light = turn_about_y(environment.coefficients(bands), angle_rad);
    frame.environment_from_world =
        Eigen::AngleAxisf(static_cast<float>(-angle_rad), Vec3f::UnitY()).toRotationMatrix();
}

std::vector<Vec3f> vertex_radiance(const CodedMesh& mesh, double time, const DecodeLimits& limits,
                                   const LightCoefficients& light) {
    DecodedPose pose;
    MeshDecoder(mesh).decode(time, limits, pose);
    std::vector<Vec3f> radiance;
    shade(pose.layout, pose.transfer, mesh.albedo, to_local(light, pose.root), radiance);
    std::vector<Vec3f> in_scene;
    shade(pose.layout, pose.transfer, mesh.albedo, light, in_scene);
    for (size_t v = pose.num_following; v < radiance.size(); ++v) radiance[v] = in_scene[v];
    return radiance;
}

}  // namespace paim::player
