// A bending sphere.
#include "tests/player/test_model.h"

#include <Eigen/Core>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/codec/svd_decoder.h"
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

void fill(LowRankMatrix& matrix, const std::vector<Vec3f>& positions, uint64_t seed,
          double mean_scale, double weight_scale) {
    RandomStream random(stream_key(seed, matrix.num_planes, matrix.num_components));
    const bool half = matrix.precision == Precision::f16;
    const auto append_waves = [&](std::vector<float>& out, double scale, bool round) {
        for (uint32_t plane = 0; plane < matrix.num_planes; ++plane) {
            const Wave wave(random);
            for (const Vec3f& position : positions) {
                const auto value = static_cast<float>(scale * wave.at(position));
                out.push_back(round ? static_cast<float>(Eigen::half(value)) : value);
            }
        }
    };
    std::vector<float> mean;
    append_waves(mean, mean_scale, false);
    matrix.mean = std::move(mean);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        std::vector<float> component;
        append_waves(component, 1.0, half);
        matrix.components.emplace_back(std::move(component));
    }
    for (uint32_t i = 0; i < matrix.num_components * matrix.num_poses; ++i) {
        matrix.weights.push_back(static_cast<float>(weight_scale * (random.uniform() - 0.5)));
    }
    matrix.singular_values.assign(matrix.num_components, 1.0);
}

LowRankMatrix matrix_of(const Topology& topology, uint32_t num_planes, uint32_t num_components,
                        const TestModelOptions& options) {
    LowRankMatrix matrix;
    matrix.num_points = topology.num_vertices;
    matrix.num_planes = num_planes;
    matrix.num_poses = options.num_poses;
    matrix.num_components = num_components;
    matrix.precision = options.precision;
    return matrix;
}

}  // namespace

Model make_test_model(const TestModelOptions& options) {
    const uint32_t num_segments = 2 * options.num_rings;
    const std::vector<Vec3f> positions = sphere_positions(options.num_rings, num_segments);
    Model model;
    model.name = "test";
    model.topology = sphere_topology(options.num_rings, num_segments);
    model.layout.bands = options.bands;
    model.layout.channels = options.channels;
    model.geometry = matrix_of(model.topology, 3, options.geometry_components, options);
    fill(model.geometry, positions, 1, 0.0, 0.2);
    model.geometry.mean = to_planes(positions);
    model.transfer =
        matrix_of(model.topology, model.layout.num_planes(), options.transfer_components, options);
    fill(model.transfer, positions, 2, 0.3, 0.3);
    std::vector<float> mean = model.transfer.mean.floats();
    // The constant coefficient of each channel keeps radiance away from zero.
    for (uint32_t channel = 0; channel < options.channels; ++channel) {
        float* plane =
            mean.data() + size_t{model.layout.plane(channel, 0)} * model.topology.num_vertices;
        for (size_t v = 0; v < positions.size(); ++v) plane[v] += 2.0f;
    }
    model.transfer.mean = std::move(mean);
    if (options.albedo_per_vertex) {
        RandomStream random(stream_key(3, 0, 0));
        model.albedo.values.clear();
        const Wave red(random), green(random), blue(random);
        for (const Vec3f& p : positions) {
            model.albedo.values.push_back(
                Vec3d(0.5 + 0.4 * red.at(p), 0.5 + 0.4 * green.at(p), 0.5 + 0.4 * blue.at(p))
                    .cast<float>());
        }
    } else {
        model.albedo.values = {Vec3f(0.9f, 0.6f, 0.3f)};
    }
    return model;
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

std::vector<Vec3f> vertex_radiance(const Model& model, double time, const DecodeLimits& limits,
                                   const LightCoefficients& light) {
    DecodedPose pose;
    SvdDecoder(model).decode(time, limits, pose);
    std::vector<Vec3f> radiance;
    shade(pose.layout, pose.transfer, model.albedo, light, radiance);
    return radiance;
}

}  // namespace paim::player
