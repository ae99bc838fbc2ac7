// Decoding and lighting frames of codec cpca.
#include "analysis/bench/decode_frames.h"
#include "paim/base/seed.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/mesh_decoder.h"

namespace paim::bench {

namespace {

// 256 clusters of 8 components. Vertices come in runs of a dozen of one cluster, as they do along
// the surface of a mesh.
CodedMesh clustered_mesh(uint32_t num_vertices, uint32_t num_components, Precision precision) {
    CodedMesh mesh = random_mesh(num_vertices, num_components, precision);
    VertexClusters clusters;
    clusters.num_clusters = 256;
    clusters.num_components = 8;
    RandomStream random(5);
    for (uint32_t v = 0; v < num_vertices; ++v) {
        const auto another = static_cast<uint32_t>(255.999 * random.uniform());
        clusters.cluster.push_back(v % 12 == 0 ? another : clusters.cluster.back());
    }
    clusters.coefficients.assign(clusters.num_components, random_values(precision, num_vertices));
    clusters.scales.assign(clusters.num_rows(), 0.5f);
    LowRank bases =
        random_matrix(clusters.num_rows(), mesh.layout.num_planes(), num_components, precision);
    mesh.transfer = CpcaTransfer(std::move(bases), std::move(clusters));
    return mesh;
}

void decode_clusters(benchmark::State& state, uint32_t num_vertices, uint32_t num_components,
                     Precision precision) {
    measure_decoding(state, clustered_mesh(num_vertices, num_components, precision));
}

// A frame as clustered transfer is played: positions, and the light before the coefficients of
// vertices, so that what is left of the transfer is each vertex's radiance.
void light_clusters(benchmark::State& state, uint32_t num_vertices, uint32_t num_components,
                    Precision precision) {
    const CodedMesh mesh = clustered_mesh(num_vertices, num_components, precision);
    const LightCoefficients light{
        kDecodedBands, std::vector<Vec3f>(sh::num_coefficients(kDecodedBands), Vec3f(1, 2, 3))};
    const std::unique_ptr<TransferPlayer> player = mesh.transfer->make_player(mesh.layout);
    PositionDecoder decoder;
    std::vector<float> positions;
    std::vector<Vec3f> radiance;
    measure_frames(state, mesh, bytes_written(mesh, 3), [&](double time) {
        decoder.decode(mesh.positions, time, num_components, positions);
        player->light(time, {}, light, mesh.albedo, radiance);
        benchmark::DoNotOptimize(positions.data());
        benchmark::DoNotOptimize(radiance.data());
    });
}

BENCHMARK_CAPTURE(decode_clusters, small, 1000, 4, Precision::i8)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_clusters, f32, 100000, 16, Precision::f32)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_clusters, i16, 100000, 16, Precision::i16)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_clusters, i8, 100000, 16, Precision::i8)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_clusters, i8_vertices_800000, 800000, 16, Precision::i8)
    ->Apply(on_threads);
BENCHMARK_CAPTURE(light_clusters, small, 1000, 4, Precision::i8)->Apply(on_threads);
BENCHMARK_CAPTURE(light_clusters, f32, 100000, 16, Precision::f32)->Apply(on_threads);
BENCHMARK_CAPTURE(light_clusters, i16, 100000, 16, Precision::i16)->Apply(on_threads);
BENCHMARK_CAPTURE(light_clusters, i8, 100000, 16, Precision::i8)->Apply(on_threads);
BENCHMARK_CAPTURE(light_clusters, i8_vertices_800000, 800000, 16, Precision::i8)->Apply(on_threads);

}  // namespace

}  // namespace paim::bench
