// How much memory encoding takes, and how much may be worked on at once below a limit.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/options.h"

namespace paim {

class BakeReader;

// What encoding's memory depends on. Rows are streamed; vertices matter for albedo and for noise.
struct EncodeSize {
    uint64_t num_triangles = 0;
    uint64_t num_colours = 1;
    uint64_t num_poses = 0;
    uint64_t num_components = 0;  // the larger part's, at most num_poses
    uint64_t num_threads = 1;
    uint64_t num_vertices = 0;
    uint64_t bands = 1;
    uint64_t scenery_bytes = 0;  // of the scenery as it was baked
};

// Of a bake: all of its poses as components.
EncodeSize bake_size(const BakeReader& bake);

// What encoding makes of it.
EncodeSize encode_size(EncodeSize bake, const EncodeOptions& options);
EncodeSize encode_size(const BakeReader& bake, const EncodeOptions& options);

// Measured: code, libraries and threads are 18 MB before any data.
constexpr uint64_t kProgramBytes = 24'000'000;

// As messages say it: "13 GB", "250 MB".
std::string memory_text(uint64_t bytes);

// Peak memory of the process, an upper bound: with `num_in_flight` runs of rows factored side by side.
uint64_t encode_memory_bytes(const EncodeSize& size, uint32_t num_in_flight);

// The most runs in flight, a power of two, that stay below limit_bytes.
// Error (unsupported) naming `what` and the memory that one alone would need.
uint32_t choose_num_in_flight(const EncodeSize& size, uint64_t limit_bytes,
                              const std::string& what);

}  // namespace paim
