// Decoding a frame, against a plain copy of the bytes it reads.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstring>
#include <functional>

#include "analysis/bench/ratio.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/codec/make_decoder.h"
#include "paim/codec/pose_parts.h"
#include "paim/shade/cluster_light.h"

namespace paim::bench {

namespace {

constexpr uint32_t kBands = 5;

template <typename T>
StoredValues random_values(size_t count, double limit) {
    RandomStream random(count);
    std::vector<T> values(count);
    for (T& value : values) value = static_cast<T>(limit * (2.0 * random.uniform() - 1.0));
    return values;
}

StoredValues random_values(Precision precision, size_t count) {
    if (precision == Precision::i8) return random_values<int8_t>(count, 127.0);
    if (precision == Precision::i16) return random_values<int16_t>(count, 32767.0);
    return random_values<float>(count, 1.0);
}

LowRankMatrix random_matrix(uint32_t num_points, uint32_t num_planes, uint32_t num_components,
                            Precision precision) {
    LowRankMatrix matrix;
    matrix.num_points = num_points;
    matrix.num_planes = num_planes;
    matrix.num_poses = 50;
    matrix.num_components = num_components;
    matrix.precision = precision;
    if (is_integer(precision)) matrix.steps.assign(num_planes, 0.01f);
    matrix.mean = random_values(precision, matrix.num_rows());
    matrix.components.assign(num_components, matrix.mean);
    matrix.weights = random_values<float>(size_t{num_components} * matrix.num_poses, 1.0).floats();
    return matrix;
}

Model svd_model(uint32_t num_vertices, uint32_t num_components, Precision precision) {
    Model model;
    model.topology.num_vertices = num_vertices;
    model.layout = {TransferKind::diffuse, kBands, 1};
    model.geometry = random_matrix(num_vertices, 3, num_components, precision);
    model.transfer =
        random_matrix(num_vertices, model.layout.num_planes(), num_components, precision);
    return model;
}

// 256 clusters of 8 components. Vertices come in runs of a dozen of one cluster, as they do along the
// surface of a mesh.
Model clustered_model(uint32_t num_vertices, uint32_t num_components, Precision precision) {
    Model model = svd_model(num_vertices, num_components, precision);
    VertexClusters& clusters = model.clusters;
    clusters.num_clusters = 256;
    clusters.num_components = 8;
    RandomStream random(5);
    for (uint32_t v = 0; v < num_vertices; ++v) {
        const auto another = static_cast<uint32_t>(255.999 * random.uniform());
        clusters.cluster.push_back(v % 12 == 0 ? another : clusters.cluster.back());
    }
    clusters.coefficients.assign(clusters.num_components, random_values(precision, num_vertices));
    clusters.scales.assign(clusters.num_rows(), 0.5f);
    model.transfer =
        random_matrix(clusters.num_rows(), model.layout.num_planes(), num_components, precision);
    return model;
}

// Bytes that a frame with everything in it is made from.
size_t bytes_read(const Model& model) {
    size_t bytes = 0;
    for (const LowRankMatrix* matrix : {&model.geometry, &model.transfer}) {
        bytes += matrix->mean.size_bytes();
        for (const StoredValues& component : matrix->components) bytes += component.size_bytes();
        bytes += 2 * sizeof(float) * matrix->num_components;  // of two poses
    }
    bytes += std::span(model.clusters.cluster).size_bytes();
    bytes += std::span(model.clusters.scales).size_bytes();
    for (const StoredValues& values : model.clusters.coefficients) bytes += values.size_bytes();
    return bytes;
}

// What decoding leaves: positions and `planes` values of a vertex.
size_t bytes_written(const Model& model, uint32_t planes) {
    return sizeof(float) * (size_t{3} + planes) * model.topology.num_vertices;
}

// One call of memcpy a thread.
class Copy {
  public:
    explicit Copy(size_t num_bytes) : from_(num_bytes, 1), to_(num_bytes, 2) {}

    void run(int num_threads) {
        const auto share = (from_.size() + static_cast<size_t>(num_threads) - 1) /
                           static_cast<size_t>(num_threads);
        parallel_for(from_.size(), share, [&](size_t begin, size_t end) {
            std::memcpy(to_.data() + begin, from_.data() + begin, end - begin);
        });
        benchmark::DoNotOptimize(to_.data());
        benchmark::ClobberMemory();
    }

  private:
    std::vector<uint8_t> from_, to_;
};

// Counters, medians over the iterations:
//   of_copy_bandwidth       time to copy the bytes that a frame is made from / time to decode it, wall
//                           clock; _cpu: processor's time of all threads
//   of_balanced_bandwidth   the same of a copy that moves as many bytes as the decoder: half as many
//                           as it reads and writes together
//   read_GB_s               what the decoder reads in a second
void measure(benchmark::State& state, const Model& model, size_t num_bytes_written,
             const std::function<void(double time)>& decode_frame) {
    const auto num_threads = static_cast<int>(state.range(0));
    const ThreadLimit limit(num_threads);
    Copy copy(bytes_read(model));
    Copy balanced_copy((bytes_read(model) + num_bytes_written) / 2);
    double time = 0.0;
    std::vector<double> ratios, cpu_ratios, balanced_ratios, our_times;
    for (auto _ : state) {
        const Times read = timed([&] { copy.run(num_threads); });
        const Times moved = timed([&] { balanced_copy.run(num_threads); });
        time = time < 48.0 ? time + 0.37 : 0.0;
        const Times ours = timed([&] {
            decode_frame(time);
            benchmark::ClobberMemory();
        });
        state.SetIterationTime(ours.wall_s);
        ratios.push_back(read.wall_s / ours.wall_s);
        cpu_ratios.push_back(read.cpu_s / ours.cpu_s);
        balanced_ratios.push_back(moved.wall_s / ours.wall_s);
        our_times.push_back(ours.wall_s);
    }
    state.counters["of_copy_bandwidth"] = median(ratios);
    state.counters["of_copy_bandwidth_cpu"] = median(cpu_ratios);
    state.counters["of_balanced_bandwidth"] = median(balanced_ratios);
    state.counters["read_GB_s"] = 1e-9 * static_cast<double>(bytes_read(model)) / median(our_times);
    state.counters["per_vertex_ns"] = 1e9 * median(our_times) / model.topology.num_vertices;
}

// Positions and transfer of every vertex.
void decode(benchmark::State& state, const Model& model) {
    const std::unique_ptr<Decoder> decoder = make_decoder(model);
    DecodedPose pose;
    measure(state, model, bytes_written(model, model.layout.num_planes()), [&](double time) {
        decoder->decode(time, {}, pose);
        benchmark::DoNotOptimize(pose.transfer.data());
    });
}

void decode_svd(benchmark::State& state, uint32_t num_vertices, uint32_t num_components,
                Precision precision) {
    decode(state, svd_model(num_vertices, num_components, precision));
}

void decode_clusters(benchmark::State& state, uint32_t num_vertices, uint32_t num_components,
                     Precision precision) {
    decode(state, clustered_model(num_vertices, num_components, precision));
}

// A frame as clustered transfer is played: positions, and the light before the weights, so that what
// is left of the transfer is each vertex's radiance.
void light_clusters(benchmark::State& state, uint32_t num_vertices, uint32_t num_components,
                    Precision precision) {
    const Model model = clustered_model(num_vertices, num_components, precision);
    const LightCoefficients light{kBands, std::vector<Vec3f>(kBands * kBands, Vec3f(1, 2, 3))};
    ClusterLight cluster_light(model);
    DecodedPose pose;
    std::vector<Vec3f> products, radiance;
    measure(state, model, bytes_written(model, 3), [&](double time) {
        decode_positions(model, time, {}, pose);
        cluster_light.basis_radiance(time, {}, light, products);
        shade_clusters(model.clusters, products, model.clusters.num_components, model.albedo,
                       radiance);
        benchmark::DoNotOptimize(pose.positions.data());
        benchmark::DoNotOptimize(radiance.data());
    });
}

void frames(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgName("threads")->Arg(1)->Arg(2)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(decode_svd, small, 1000, 4, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(decode_svd, f32, 100000, 16, Precision::f32)->Apply(frames);
BENCHMARK_CAPTURE(decode_svd, i16, 100000, 16, Precision::i16)->Apply(frames);
BENCHMARK_CAPTURE(decode_svd, i8, 100000, 16, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(decode_svd, i8_vertices_10000, 10000, 16, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(decode_clusters, small, 1000, 4, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(decode_clusters, f32, 100000, 16, Precision::f32)->Apply(frames);
BENCHMARK_CAPTURE(decode_clusters, i16, 100000, 16, Precision::i16)->Apply(frames);
BENCHMARK_CAPTURE(decode_clusters, i8, 100000, 16, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(decode_clusters, i8_vertices_800000, 800000, 16, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(light_clusters, small, 1000, 4, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(light_clusters, f32, 100000, 16, Precision::f32)->Apply(frames);
BENCHMARK_CAPTURE(light_clusters, i16, 100000, 16, Precision::i16)->Apply(frames);
BENCHMARK_CAPTURE(light_clusters, i8, 100000, 16, Precision::i8)->Apply(frames);
BENCHMARK_CAPTURE(light_clusters, i8_vertices_800000, 800000, 16, Precision::i8)->Apply(frames);

}  // namespace

}  // namespace paim::bench
