// How much memory encoding takes.
#include "compressor/encode/memory/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/encode/memory_slack.h"
#include "compressor/encode/noise/shrinkage.h"
#include "compressor/encode/svd/motion_groups.h"
#include "compressor/encode/svd/projected_blocks.h"
#include "compressor/encode/svd/tsqr.h"
#include "compressor/encode/svd/vertex_motion.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "paim/codec/low_rank.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/outliers.h"

namespace paim {

namespace {

// Of the one block that is written, the rows of all exceptions.
uint64_t exception_rows_bytes(uint64_t num_poses, uint64_t num_exceptions) {
    return rows_per_block(static_cast<uint32_t>(num_poses)) * num_exceptions * sizeof(float);
}

}  // namespace

std::string memory_text(uint64_t bytes) {
    return bytes >= 10'000'000'000 ? fmt::format("{:.0f} GB", static_cast<double>(bytes) * 1e-9)
                                   : fmt::format("{} MB", bytes / 1'000'000 + 1);
}

uint64_t still_mesh_bytes(const Topology& topology, const Albedo& albedo,
                          const TransferLayout& layout) {
    return baked_pose_bytes(topology.num_vertices, layout) +
           topology.triangles.size() * sizeof(Triangle) + albedo.values.size() * sizeof(Vec3f);
}

EncodeSize bake_size(const BakeReader& bake) {
    const TransferLayout& layout = bake.identity().layout;
    EncodeSize size;
    size.num_triangles = bake.topology().triangles.size();
    size.num_colours = bake.albedo().values.size();
    size.num_poses = size.num_components = bake.num_poses();
    size.num_threads = static_cast<uint64_t>(max_parallelism());
    size.num_vertices = bake.identity().num_vertices;
    size.bands = layout.in_bands;
    size.texture_bytes = bake.texture().size_bytes();
    if (bake.still_mesh()) {
        size.still_mesh_bytes =
            still_mesh_bytes(bake.still_mesh()->topology, bake.still_mesh()->albedo, layout);
        size.texture_bytes += bake.still_mesh()->texture.size_bytes();
    }
    return size;
}

EncodeSize encode_size(EncodeSize bake, const EncodeOptions& options) {
    const auto components = [&](const ComponentChoice& choice) {
        const bool counted = choice.kind == ComponentChoice::Kind::number;
        return counted ? std::min<uint64_t>(choice.number, bake.num_poses) : bake.num_poses;
    };
    bake.num_components = std::max(components(options.geometry), components(options.transfer));
    bake.bands = std::min<uint64_t>(options.bands, bake.bands);
    return bake;
}

EncodeSize encode_size(const BakeReader& bake, const EncodeOptions& options) {
    return encode_size(bake_size(bake), options);
}

EncodeSize with_outliers(EncodeSize size, const PositionOutliers& outliers) {
    size.outlier_bytes = outliers.size_bytes();
    size.num_exceptions = kExceptionsPerPose * outliers.poses().size();
    return size;
}

uint64_t mesh_bytes(uint64_t num_triangles, uint64_t num_colours) {
    return num_triangles * sizeof(Triangle) + num_colours * sizeof(Vec3f);
}

uint64_t encode_memory_bytes(const EncodeSize& size, uint32_t num_in_flight) {
    // P and K are below 2^20 and threads below 2^10, so that nothing here overflows.
    const uint64_t poses = size.num_poses, components = size.num_components;
    // The bake and the model hold the mesh and the still mesh; each part keeps its V and its
    // weights. A section of a texture is copied once more while it is written.
    const uint64_t held =
        2 * mesh_bytes(size.num_triangles, size.num_colours) + 2 * size.still_mesh_bytes +
        3 * size.texture_bytes + kPoseNameBytes * poses +
        2 * (principal_components_bytes(poses) + poses * components * sizeof(float)) +
        component_noise_bytes(size.num_vertices, size.bands) +
        Shrinkage::held_bytes(size.num_vertices, size.bands) + 4 * size.outlier_bytes +
        poses * size.num_exceptions * sizeof(float);
    const auto rows_at_work = [&](uint64_t num_blocks) {
        return rows_at_work_bytes(poses, components, size.num_threads, num_blocks);
    };
    const uint64_t measured_at_once = std::min(num_in_flight, kMaxMeasuredAtOnce);
    const uint64_t streamed = std::max(
        {triangular_factor_bytes(poses, num_in_flight) + rows_at_work(num_in_flight),
         jacobi_svd_bytes(poses), outliers_bytes(size.num_vertices, poses, size.num_threads),
         motion_groups_bytes(size.num_vertices, poses) +
             components_for_motion_bytes(size.num_vertices, poses, size.num_threads),
         component_noise_scratch_bytes(poses, size.bands, num_in_flight) +
             rows_at_work(measured_at_once),
         encoded_blocks_bytes(poses, components, num_in_flight) + rows_at_work(num_in_flight) +
             exception_rows_bytes(poses, size.num_exceptions)});
    return kProgramBytes + with_memory_slack(held + streamed);
}

uint32_t choose_num_in_flight(const EncodeSize& size, uint64_t limit_bytes,
                              const std::string& what) {
    const uint64_t least = encode_memory_bytes(size, 1);
    if (least > limit_bytes) {
        throw_unsupported(
            "{}: {} poses of {} vertices in {} bands need {} of memory to be encoded, but --memory "
            "allows {}",
            what, size.num_poses, size.num_vertices, size.bands, memory_text(least),
            memory_text(limit_bytes - 1));
    }
    uint32_t num_in_flight = kMaxInFlight;
    while (encode_memory_bytes(size, num_in_flight) > limit_bytes) num_in_flight /= 2;
    return num_in_flight;
}

}  // namespace paim
