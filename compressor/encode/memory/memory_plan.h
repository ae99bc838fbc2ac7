// How much memory encoding takes, and how many rows may be worked on at once below a limit.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/options.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

class BakeReader;
class PositionOutliers;

// What the memory of encoding depends on. Rows are streamed: vertices count for their albedo and
// their noise only.
struct EncodeSize {
    uint64_t num_triangles = 0;
    uint64_t num_colours = 1;
    uint64_t num_poses = 0;
    uint64_t num_components = 0;  // of the part that has more of them, at most num_poses
    uint64_t num_threads = 1;
    uint64_t num_vertices = 0;
    uint64_t bands = 1;
    uint64_t still_mesh_bytes = 0;  // still_mesh_bytes() of the bake
    uint64_t texture_bytes = 0;     // of the images and coordinates of all parts
    uint64_t outlier_bytes = 0;     // of those that were found (mesh/outliers.h)
    uint64_t num_exceptions = 0;    // components that they take, at most
};

// Memory of the still mesh of a bake: its baked pose, triangles and colours.
uint64_t still_mesh_bytes(const Topology& topology, const Albedo& albedo,
                          const TransferLayout& layout);

// Memory of triangles and colours.
uint64_t mesh_bytes(uint64_t num_triangles, uint64_t num_colours);

// The size of a bake, with as many components as poses.
EncodeSize bake_size(const BakeReader& bake);

// The same with the components and bands that the options ask for.
EncodeSize encode_size(EncodeSize bake, const EncodeOptions& options);
EncodeSize encode_size(const BakeReader& bake, const EncodeOptions& options);

// The same with the outliers that were found.
EncodeSize with_outliers(EncodeSize size, const PositionOutliers& outliers);

// Measured: code, libraries and threads take 18 MB before there are any data.
constexpr uint64_t kProgramBytes = 24'000'000;

// The name of a pose's file and its checksum, with room to spare.
constexpr uint64_t kPoseNameBytes = 512;

// For messages: "13 GB", "250 MB".
std::string memory_text(uint64_t bytes);

// Peak memory of the process, an upper bound, with `num_in_flight` runs of rows factored side by
// side.
uint64_t encode_memory_bytes(const EncodeSize& size, uint32_t num_in_flight);

// The largest number of runs in flight, a power of two, that stays below limit_bytes.
// Error (unsupported), naming `what` and the memory that is needed, if even one run does not.
uint32_t choose_num_in_flight(const EncodeSize& size, uint64_t limit_bytes,
                              const std::string& what);

}  // namespace paim
