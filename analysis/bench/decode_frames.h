// Decoding frames of made-up meshes of any codec, against a plain copy of the bytes that it reads.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <functional>

#include "paim/codec/asset.h"

namespace paim::bench {

constexpr uint32_t kDecodedBands = 5;

// Values that fill the range of the precision.
StoredValues random_values(Precision precision, size_t count);

LowRank random_matrix(uint32_t num_points, uint32_t num_planes, uint32_t num_components,
                      Precision precision);

// Positions and transfer of random values; its points are the vertices.
CodedMesh random_mesh(uint32_t num_vertices, uint32_t num_components, Precision precision);

// What decoding leaves: positions and `planes` values of a vertex.
size_t bytes_written(const CodedMesh& mesh, uint32_t planes);

// Counters, medians over the iterations:
//   of_copy_bandwidth       time to copy the bytes that a frame is made from / time to decode it, wall
//                           clock; _cpu: processor's time of all threads
//   of_balanced_bandwidth   the same of a copy that moves as many bytes as the decoder: half as many
//                           as it reads and writes together
//   read_GB_s               what the decoder reads in a second
void measure_frames(benchmark::State& state, const CodedMesh& mesh, size_t num_bytes_written,
                    const std::function<void(double time)>& decode_frame);

// The same of decoding positions and transfer of every vertex.
void measure_decoding(benchmark::State& state, const CodedMesh& mesh);

// On one and on two threads.
void on_threads(benchmark::internal::Benchmark* benchmark);

}  // namespace paim::bench
