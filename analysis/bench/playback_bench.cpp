// Decoding, shading and the basis: processor time per vertex and per direction.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "paim/base/seed.h"
#include "paim/codec/codecs.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/sh/basis.h"
#include "paim/shade/shade.h"

namespace paim::bench {

namespace {

constexpr uint32_t kBands = 5;

void fill(std::vector<float>& values, size_t count) {
    RandomStream random(count);
    values.resize(count);
    for (float& value : values) value = static_cast<float>(random.uniform()) - 0.5f;
}

LowRank random_matrix(uint32_t num_vertices, uint32_t num_planes, uint32_t num_components) {
    LowRank matrix;
    matrix.num_points = num_vertices;
    matrix.num_planes = num_planes;
    matrix.num_poses = 50;
    matrix.num_components = num_components;
    std::vector<float> values;
    fill(values, matrix.num_rows());
    matrix.mean = values;
    for (uint32_t k = 0; k < num_components; ++k) {
        fill(values, matrix.num_rows());
        matrix.components.emplace_back(values);
    }
    fill(matrix.weights, size_t{num_components} * matrix.num_poses);
    return matrix;
}

// Processor seconds per item.
void per_item(benchmark::State& state, const char* name, double num_items) {
    state.counters[name] = benchmark::Counter(
        num_items, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void decode(benchmark::State& state, uint32_t num_vertices, uint32_t num_components) {
    CodedMesh mesh;
    mesh.topology.num_vertices = num_vertices;
    mesh.layout = {TransferKind::diffuse, kBands, 1};
    mesh.positions = random_matrix(num_vertices, 3, num_components);
    mesh.transfer =
        plain_transfer(random_matrix(num_vertices, mesh.layout.num_planes(), num_components));
    MeshDecoder decoder(mesh);
    DecodedPose pose;
    double time = 0.0;
    for (auto _ : state) {
        time = time < 48.0 ? time + 0.37 : 0.0;
        decoder.decode(time, {}, pose);
        benchmark::DoNotOptimize(pose.transfer.data());
        benchmark::ClobberMemory();
    }
    per_item(state, "per_vertex", num_vertices);
}

void shade(benchmark::State& state, uint32_t num_vertices) {
    std::vector<float> transfer;
    fill(transfer, size_t{kBands} * kBands * num_vertices);
    const LightCoefficients light{kBands, std::vector<Vec3f>(kBands * kBands, Vec3f(1, 2, 3))};
    const Albedo albedo{{Vec3f(0.5f, 0.6f, 0.7f)}};
    std::vector<Vec3f> radiance;
    for (auto _ : state) {
        shade({TransferKind::diffuse, kBands, 1}, transfer, albedo, light, radiance);
        benchmark::DoNotOptimize(radiance.data());
        benchmark::ClobberMemory();
    }
    per_item(state, "per_vertex", num_vertices);
}

void basis(benchmark::State& state, int bands) {
    constexpr int kBatch = sh::BatchBasis::kBatch;
    const sh::BatchBasis batch(bands);
    std::vector<float> x(kBatch), y(kBatch), z(kBatch);
    RandomStream random(3);
    for (size_t j = 0; j < kBatch; ++j) {
        const Vec3d direction =
            Vec3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
                .normalized();
        x[j] = static_cast<float>(direction.x());
        y[j] = static_cast<float>(direction.y());
        z[j] = static_cast<float>(direction.z());
    }
    std::vector<float> values(static_cast<size_t>(sh::num_coefficients(bands) * kBatch));
    for (auto _ : state) {
        batch.evaluate(x.data(), y.data(), z.data(), values.data());
        benchmark::DoNotOptimize(values.data());
        benchmark::ClobberMemory();
    }
    per_item(state, "per_direction", kBatch);
}

// Decoding runs on all cores: the time of all of them is counted.
BENCHMARK_CAPTURE(decode, small, 1000, 4)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(decode, vertices_10000_components_16, 10000, 16)->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(shade, small, 1000);
BENCHMARK_CAPTURE(shade, vertices_10000, 10000);
BENCHMARK_CAPTURE(basis, small, 3);
BENCHMARK_CAPTURE(basis, bands_5, 5);
BENCHMARK_CAPTURE(basis, bands_10, 10);
BENCHMARK_CAPTURE(basis, bands_16, 16);
BENCHMARK_CAPTURE(basis, bands_17, 17);
BENCHMARK_CAPTURE(basis, bands_64, 64);

}  // namespace

}  // namespace paim::bench
