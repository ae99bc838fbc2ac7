// How much memory encoding takes.
#include "compressor/encode/memory/memory_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/svd/principal_components.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

// P, K below 2^20 and threads below 2^10, so that nothing here overflows.
struct Need {
    uint64_t poses, components, threads, in_flight;

    static constexpr uint64_t kDouble = sizeof(double);

    // Rows in double while they are centred, mapped and folded or projected, and as they were read.
    uint64_t working_bytes() const { return working_bytes(in_flight); }
    uint64_t working_bytes(uint64_t blocks) const {
        const uint64_t block = rows_per_block(static_cast<uint32_t>(poses)) * poses * sizeof(float);
        const auto at_once = static_cast<uint64_t>(kRowsAtOnce);
        const uint64_t rows = at_once * (2 * poses + 2 * components) * kDouble;
        return std::min(threads, blocks) * (block + rows);
    }

    // Those in flight, and those that wait for their neighbours in the tree.
    uint64_t factors_bytes(uint64_t columns) const {
        const auto waiting = static_cast<uint64_t>(std::bit_width(kMaxInFlight / in_flight)) - 1;
        return (in_flight + waiting) * columns * columns * kDouble;
    }

    // jacobi_svd(): the factor, its rows, the work space, V.
    uint64_t decomposing_bytes() const { return 4 * poses * poses * kDouble; }

    // measure_component_noise(): a copy of V, the energies of the blocks, and the blocks.
    uint64_t measuring_bytes(uint64_t bands) const {
        const uint64_t blocks = std::min<uint64_t>(in_flight, kMaxMeasuredAtOnce);
        return poses * poses * kDouble + 2 * (blocks + 1) * bands * poses * kDouble +
               working_bytes(blocks);
    }

    // V S⁻¹, the correction with its temporaries, and either its factors or blocks that are done.
    uint64_t output_bytes() const {
        const uint64_t block =
            rows_per_block(static_cast<uint32_t>(poses)) * (components + 1) * sizeof(float);
        const uint64_t done = std::min<uint64_t>(in_flight, kMaxBlocksWaiting) * block;
        return (poses + 3 * components) * components * kDouble +
               std::max(factors_bytes(components), done) + working_bytes();
    }
};

}  // namespace

std::string memory_text(uint64_t bytes) {
    return bytes >= 10'000'000'000 ? fmt::format("{:.0f} GB", static_cast<double>(bytes) * 1e-9)
                                   : fmt::format("{} MB", bytes / 1'000'000 + 1);
}

EncodeSize bake_size(const BakeReader& bake) {
    uint64_t scenery_bytes = 0;
    if (bake.scenery()) {
        const BakedPose& still = bake.scenery()->pose;
        scenery_bytes = sizeof(float) * (still.positions.size() + still.normals.size() +
                                         still.transfer.size() + still.noise.size());
        scenery_bytes += sizeof(Triangle) * bake.scenery()->topology.triangles.size() +
                         sizeof(Vec3f) * bake.scenery()->albedo.values.size();
    }
    const TransferLayout& layout = bake.identity().layout;
    return {bake.topology().triangles.size(),
            bake.albedo().values.size(),
            bake.num_poses(),
            bake.num_poses(),
            static_cast<uint64_t>(max_parallelism()),
            bake.identity().num_vertices,
            layout.bands,
            scenery_bytes};
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

uint64_t encode_memory_bytes(const EncodeSize& size, uint32_t num_in_flight) {
    // The mesh is held twice (the bake's and the model's), as are names and checksums of poses; each
    // part keeps its V and its weights.
    const uint64_t mesh = 2 * (size.num_triangles + size.num_colours) * 12;
    const uint64_t names = 512 * size.num_poses;
    const uint64_t kept = 2 * size.num_poses *
                          (size.num_poses * sizeof(double) + size.num_components * sizeof(float));
    // Energy and noise of each vertex and band, measured and as the shrinkage keeps them.
    const uint64_t vertices = 4 * size.bands * size.num_vertices * sizeof(double);
    // What stands still is held whole, by the bake and by the model.
    const uint64_t scenery = 2 * size.scenery_bytes;
    const Need need{size.num_poses, size.num_components, size.num_threads, num_in_flight};
    const uint64_t streamed =
        std::max({need.factors_bytes(size.num_poses) + need.working_bytes(),
                  need.decomposing_bytes(), need.measuring_bytes(size.bands), need.output_bytes()});
    // The allocator keeps some of what was freed: a quarter more.
    return kProgramBytes + (mesh + names + kept + vertices + scenery + streamed) / 4 * 5;
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
