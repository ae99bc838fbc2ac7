// Decoding frames, against a plain copy of the bytes that it reads.
#include "analysis/bench/decode_frames.h"

#include <algorithm>
#include <cstring>
#include <variant>

#include "analysis/bench/ratio.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/codec/codecs.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/section_row.h"

namespace paim::bench {

namespace {

template <typename T>
StoredValues random_values(size_t count, double limit) {
    RandomStream random(count);
    std::vector<T> values(count);
    for (T& value : values) value = static_cast<T>(limit * (2.0 * random.uniform() - 1.0));
    return values;
}

}  // namespace

StoredValues random_values(Precision precision, size_t count) {
    if (precision == Precision::i8) return random_values<int8_t>(count, 127.0);
    if (precision == Precision::i16) return random_values<int16_t>(count, 32767.0);
    return random_values<float>(count, 1.0);
}

LowRank random_matrix(uint32_t num_points, uint32_t num_planes, uint32_t num_components,
                      Precision precision) {
    LowRank matrix;
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

CodedMesh random_mesh(uint32_t num_vertices, uint32_t num_components, Precision precision) {
    CodedMesh mesh;
    mesh.topology.num_vertices = num_vertices;
    mesh.layout = {TransferKind::diffuse, kDecodedBands, 1};
    mesh.positions = random_matrix(num_vertices, 3, num_components, precision);
    mesh.transfer = plain_transfer(
        random_matrix(num_vertices, mesh.layout.num_planes(), num_components, precision));
    return mesh;
}

namespace {

// Bytes of the values of a section.
struct InMemory {
    size_t operator()(const std::vector<float>* values) const {
        return std::span(*values).size_bytes();
    }
    size_t operator()(const StoredValues* values) const { return values->size_bytes(); }
    size_t operator()(const SmallNumbers& numbers) const {
        return std::span(*numbers.values).size_bytes();
    }
};

// Bytes that a frame with everything in it is made from.
size_t bytes_read(const CodedMesh& mesh) {
    size_t bytes = 0;
    for (const LowRank* matrix : {&mesh.positions, &mesh.transfer->matrix}) {
        bytes += matrix->mean.size_bytes();
        for (const StoredValues& component : matrix->components) bytes += component.size_bytes();
        bytes += 2 * sizeof(float) * matrix->num_components;  // of two poses
    }
    CodedTransfer transfer = mesh.transfer;  // rows name values that may be changed
    for (const SectionRow& row : transfer->sections()) {
        bytes += std::visit(InMemory(), row.values);
    }
    return bytes;
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

}  // namespace

size_t bytes_written(const CodedMesh& mesh, uint32_t planes) {
    return sizeof(float) * (size_t{3} + planes) * mesh.topology.num_vertices;
}

void measure_frames(benchmark::State& state, const CodedMesh& mesh, size_t num_bytes_written,
                    const std::function<void(double time)>& decode_frame) {
    const auto num_threads = static_cast<int>(state.range(0));
    const ThreadLimit limit(num_threads);
    const size_t num_bytes_read = bytes_read(mesh);
    Copy copy(num_bytes_read);
    Copy balanced_copy((num_bytes_read + num_bytes_written) / 2);
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
    state.counters["read_GB_s"] = 1e-9 * static_cast<double>(num_bytes_read) / median(our_times);
    state.counters["per_vertex_ns"] = 1e9 * median(our_times) / mesh.topology.num_vertices;
}

void measure_decoding(benchmark::State& state, const CodedMesh& mesh) {
    MeshDecoder decoder(mesh);
    DecodedPose pose;
    measure_frames(state, mesh, bytes_written(mesh, mesh.layout.num_planes()), [&](double time) {
        decoder.decode(time, {}, pose);
        benchmark::DoNotOptimize(pose.transfer.data());
    });
}

void on_threads(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgName("threads")->Arg(1)->Arg(2)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

}  // namespace paim::bench
