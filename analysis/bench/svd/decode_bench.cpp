// Decoding frames of codec svd.
#include "analysis/bench/decode_frames.h"

namespace paim::bench {

namespace {

void decode_svd(benchmark::State& state, uint32_t num_vertices, uint32_t num_components,
                Precision precision) {
    measure_decoding(state, random_mesh(num_vertices, num_components, precision));
}

BENCHMARK_CAPTURE(decode_svd, small, 1000, 4, Precision::i8)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_svd, f32, 100000, 16, Precision::f32)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_svd, i16, 100000, 16, Precision::i16)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_svd, i8, 100000, 16, Precision::i8)->Apply(on_threads);
BENCHMARK_CAPTURE(decode_svd, i8_vertices_10000, 10000, 16, Precision::i8)->Apply(on_threads);

}  // namespace

}  // namespace paim::bench
