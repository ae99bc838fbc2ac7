// How much memory it takes to encode to a target.
#include "compressor/encode/memory/target_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/encode/memory/search_limits.h"
#include "compressor/encode/quantise/quantise.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/error.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/format/pack/plane_encoder.h"
#include "paim/metrics/asset_error.h"

namespace paim {

namespace {

constexpr uint64_t kFloat = sizeof(float), kDouble = sizeof(double);
// The largest integers of a quantised matrix.
constexpr uint64_t kInteger = sizeof(int16_t);

// Codecs are searched one after the other. What one keeps and what its best coding holds stay while
// the next ones prepare.
CodecMemory memory_of_all(const TargetSize& size) {
    CodecMemory all;
    for (const SearchedCodec& codec : size.codecs) {
        const CodecMemory one = codec.memory(size);
        all.num_points = std::max(all.num_points, one.num_points);
        all.num_points_each = std::max(all.num_points_each, one.num_points_each);
        all.kept_bytes += one.kept_bytes;
        all.preparing_bytes = std::max(all.preparing_bytes, all.coding_bytes + one.preparing_bytes);
        all.coding_bytes += one.coding_bytes;
    }
    return all;
}

// More bytes than any machine has.
constexpr uint64_t kBeyondAll = uint64_t{1} << 62;

// Whether there are so many values that sums of their bytes might not fit into 64 bits. Gloss has up to
// 2^20 planes, and files say what they like about their numbers. Up to 2^50 values (4 PB) all is well:
// nothing here holds more than 2^7 bytes for one of them.
bool is_beyond_all(const TargetSize& size) {
    const double planes = 3.0 + size.num_planes;
    const double columns = 1.0 + size.transfer_components + size.geometry_components +
                           static_cast<double>(size.streamed.num_threads);
    return planes * static_cast<double>(size.streamed.num_vertices) * columns > 0x1p50;
}

// The size is not beyond all, so that no sum or product of these overflows.
struct Need {
    const TargetSize& size;
    CodecMemory codecs = memory_of_all(size);

    uint64_t vertices() const { return size.streamed.num_vertices; }
    uint64_t poses() const { return size.streamed.num_poses; }
    uint64_t most_components() const {
        return std::max(size.geometry_components, size.transfer_components);
    }

    // Values of mean and components.
    uint64_t geometry_values() const {
        return 3 * vertices() * (size.geometry_components + uint64_t{1});
    }
    uint64_t transfer_values() const {
        return size.num_planes * vertices() * (size.transfer_components + uint64_t{1});
    }
    // The same of a codec whose points are not the vertices.
    uint64_t point_values() const {
        return codecs.num_points * size.num_planes * (size.transfer_components + uint64_t{1});
    }
    // Of outliers: components that are zero but for these.
    uint64_t exception_values() const { return 3 * vertices() * size.streamed.num_exceptions; }

    uint64_t weights() const {
        return (size.geometry_components + uint64_t{size.transfer_components} +
                size.streamed.num_exceptions) *
               poses();
    }

    // Four copies of the mesh: in the order of the bake and of the file, in the problem and in a
    // model. Each vertex has its number and the vertices that predict it, twice, and its place in
    // the bake. Textures are in the bake and in the problem, and in a file and its sections, of which
    // the best and the one that is tried are held.
    uint64_t mesh() const {
        constexpr uint64_t kPredicting = PlanePredictor::kBytesAVertex + sizeof(uint32_t);
        return 4 * mesh_bytes(size.streamed.num_triangles, size.streamed.num_colours) +
               vertices() * (2 * kPredicting + 3 * sizeof(uint32_t)) +
               4 * size.streamed.still_mesh_bytes + 6 * size.streamed.texture_bytes +
               kPoseNameBytes * poses();
    }

    // Integers of both parts, twice: the best model and the one that is tried. Positions are there
    // once more. One column is rounded at a time, as floats.
    uint64_t models() const {
        return kInteger * (3 * (geometry_values() + exception_values()) +
                           2 * std::max(transfer_values(), point_values())) +
               3 * weights() * kFloat +
               std::max(vertices(), codecs.num_points) * size.num_planes * kFloat;
    }

    uint64_t measuring() const {
        return measure_part_bytes(vertices(), poses(), most_components(), codecs.num_points,
                                  codecs.num_points_each);
    }

    // Floats of everything, to find the error that these components leave.
    uint64_t best_achievable() const {
        return (geometry_values() + exception_values() + transfer_values() + weights()) * kFloat +
               measuring();
    }

    // Thinned copies of factors or bases that steps are tried on, of all components and of those that
    // are kept, and their least squares.
    uint64_t trying() const {
        const uint64_t all = std::max(transfer_values() + geometry_values(), point_values());
        return 2 * std::min<uint64_t>(2 * kSampledValues, all) * kFloat +
               least_squares_bytes(size.num_planes, most_components(), size.streamed.num_threads);
    }

    // A plane of positions on each thread: exact, stored, smoothed and of the round before.
    uint64_t smoothing() const { return size.streamed.num_threads * 4 * vertices() * kFloat; }

    // Sections while they are compressed, one on each thread.
    uint64_t packing() const {
        const uint64_t section =
            std::max(vertices(), codecs.num_points) * std::max(3u, size.num_planes) * kInteger;
        return size.streamed.num_threads * encode_planes_scratch_bytes(section);
    }

    uint64_t factors() const {
        return (geometry_values() + transfer_values()) * kFloat + weights() * kDouble;
    }
    // The mesh as positions are smoothed and measured on, throughout.
    uint64_t neighbours() const {
        return SurfaceSmoother::bytes(vertices(), size.streamed.num_triangles) +
               PartMeter::kept_bytes(vertices(), size.streamed.num_triangles);
    }
    // Outliers are held in both orders, by the meter and in the summary.
    uint64_t held() const {
        return factors() + mesh() + neighbours() + codecs.kept_bytes +
               4 * size.streamed.outlier_bytes;
    }

    uint64_t searching() const {
        const uint64_t refining =
            models() + std::max({trying(), smoothing(), measuring(), packing()});
        return std::max(codecs.preparing_bytes, codecs.coding_bytes + refining);
    }
};

uint64_t reading_bytes(const TargetSize& size, uint32_t num_in_flight) {
    const Need need{size};
    return encode_memory_bytes(size.streamed, num_in_flight) + need.factors() + need.neighbours();
}

}  // namespace

uint64_t target_held_bytes(const TargetSize& size) {
    if (is_beyond_all(size)) return kBeyondAll;
    return kProgramBytes + Need{size}.held();
}

uint64_t target_memory_bytes(const TargetSize& size) {
    if (is_beyond_all(size)) return kBeyondAll;
    const Need need{size};
    return std::max(reading_bytes(size, 1),
                    target_held_bytes(size) + std::max(need.best_achievable(), need.searching()));
}

void check_target_memory(const TargetSize& size, const std::vector<SearchedCodec>& codecs,
                         uint64_t limit_bytes, const std::string& what) {
    const uint64_t least = target_memory_bytes(size);
    if (least <= limit_bytes) return;
    std::string instead;
    uint64_t least_of_one = limit_bytes + 1;
    for (const SearchedCodec& codec : codecs) {
        TargetSize alone = size;
        alone.codecs = {codec};
        const uint64_t bytes = target_memory_bytes(alone);
        if (bytes >= least_of_one) continue;
        least_of_one = bytes;
        instead = fmt::format(" (--codec {} alone takes {})", codec.name, memory_text(bytes));
    }
    throw_unsupported(
        "{}: {} poses of {} vertices in {} bands, with {} and {} components in memory, need {} to "
        "be encoded to a target, but --memory allows {}{}",
        what, size.streamed.num_poses, size.streamed.num_vertices, size.streamed.bands,
        size.geometry_components, size.transfer_components, memory_text(least),
        memory_text(limit_bytes - 1), instead);
}

uint32_t choose_target_in_flight(const TargetSize& size, uint64_t limit_bytes) {
    uint32_t num_in_flight = kMaxInFlight;
    while (num_in_flight > 1 && reading_bytes(size, num_in_flight) > limit_bytes) {
        num_in_flight /= 2;
    }
    return num_in_flight;
}

}  // namespace paim
