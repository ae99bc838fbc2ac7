// How much memory it takes to encode to a target.
#include "compressor/encode/memory/target_memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/encode/cluster/clustered_pca.h"
#include "compressor/encode/memory/search_limits.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/error.h"
#include "paim/format/pack/plane_predictor.h"

namespace paim {

namespace {

constexpr uint64_t kFloat = sizeof(float), kDouble = sizeof(double);
// Values of a quantised matrix, at most.
constexpr uint64_t kInteger = sizeof(int16_t);

// Points of factors, as dimensions alone.
class Dimensions : public PointSource {
  public:
    Dimensions(const TargetSize& size)
        : num_points_(static_cast<uint32_t>(size.streamed.num_vertices)),
          num_planes_(size.num_planes),
          num_columns_(size.transfer_components + 1) {}

    uint32_t num_points() const override { return num_points_; }
    uint32_t num_planes() const override { return num_planes_; }
    uint32_t num_columns() const override { return num_columns_; }
    void read(uint32_t, Eigen::Ref<Eigen::MatrixXf>) const override {}

  private:
    uint32_t num_points_, num_planes_, num_columns_;
};

// V and P below 2^28 and 2^20, planes below 2^10, so that no product of these overflows.
struct Need {
    const TargetSize& size;

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
    uint64_t weights() const {
        return (size.geometry_components + uint64_t{size.transfer_components}) * poses();
    }

    // The mesh in the bake's and in local order, in the model's frame and in a model; each vertex with
    // its number and those before it that predict it.
    uint64_t mesh() const {
        constexpr uint64_t kPredicting = PlanePredictor::kBytesAVertex + sizeof(uint32_t);
        return 4 * (size.streamed.num_triangles + size.streamed.num_colours) * 12 +
               vertices() * (2 * kPredicting + sizeof(uint64_t)) + 4 * size.streamed.scenery_bytes +
               512 * poses();
    }

    // Integers of both parts, twice: the best model and the one that is tried. One column is
    // rounded at a time, as floats.
    uint64_t models() const {
        return 2 * (kInteger * (geometry_values() + std::max(transfer_values(), basis_values())) +
                    weights() * kFloat) +
               std::max(vertices(), basis_rows()) * size.num_planes * kFloat;
    }

    // A plane over all poses: bake, noise, decoded and twice while it is decoded, with the blocks of
    // the meter.
    uint64_t measuring() const {
        constexpr uint64_t kRows = 256, kBlocks = 64, kClasses = 25;
        const uint64_t decoded = 3 * vertices() + (size.clusters ? basis_rows() : 0);
        return (2 * vertices() + decoded) * poses() * kFloat +
               vertices() * most_components() * kFloat +
               kBlocks * 3 * (most_components() + 2) * kClasses * kDouble +
               size.streamed.num_threads * kRows * 6 * poses() * kDouble;
    }

    // Floats of everything, to see what error these components leave.
    uint64_t floor() const {
        return (geometry_values() + transfer_values() + weights()) * kFloat + measuring();
    }

    // quantised_error(): a thinned copy of the factors, and what least squares need of each plane.
    uint64_t trying() const {
        constexpr uint64_t kSampled = 4'000'000;
        const uint64_t columns = 2 * most_components() + 2;
        return std::min(kSampled, transfer_values() + geometry_values()) * kFloat +
               (size.num_planes + uint64_t{4}) * most_components() * columns * kDouble +
               size.streamed.num_threads * 512 * (columns + 1) * kDouble;
    }

    // Sections as bytes while they are compressed: Zstandard's tables grow with them, up to some size.
    uint64_t packing() const {
        constexpr uint64_t kMaxTables = 92'000'000;
        const uint64_t section =
            std::max(vertices(), basis_rows()) * std::max(3u, size.num_planes) * kInteger;
        const uint64_t tables = std::min(kMaxTables, 4'000'000 + 17 * section);
        return size.streamed.num_threads * (tables + 8 * section);
    }

    uint64_t clusters() const {
        return std::min<uint64_t>(kClusterCounts.back(), most_clusters(vertices()));
    }
    uint64_t basis_rows() const {
        if (!size.clusters) return 0;
        return std::min(2 * vertices(), clusters() * (kMaxSearchedComponents + 1));
    }
    uint64_t basis_values() const {
        return basis_rows() * size.num_planes * (size.transfer_components + uint64_t{1});
    }

    // All that have been tried stay, for the next target.
    uint64_t kept_clusterings() const {
        if (!size.clusters) return 0;
        const uint64_t of_vertices = vertices() * (kMaxSearchedComponents + 3) * kFloat;
        const uint64_t of_clusters = clusters() * (kMaxSearchedComponents + 3) * kDouble;
        return kMaxClusterings * (of_vertices + of_clusters);
    }

    uint64_t clustering() const {
        if (!size.clusters) return 0;
        ClusteringOptions options;
        options.num_clusters = static_cast<uint32_t>(clusters());
        options.assumed_components = kMaxAssumedComponents;
        options.max_components = kMaxSearchedComponents;
        return clustered_pca_memory_bytes(Dimensions(size), options);
    }

    uint64_t factors() const {
        return (geometry_values() + transfer_values()) * kFloat + weights() * kDouble;
    }
    uint64_t held() const { return factors() + mesh() + kept_clusterings(); }

    uint64_t searching() const {
        return std::max(clustering(), basis_values() * kFloat +
                                          std::max(models() + std::max(trying(), measuring()),
                                                   models() + packing()));
    }
};

uint64_t reading_bytes(const TargetSize& size, uint32_t num_in_flight) {
    return encode_memory_bytes(size.streamed, num_in_flight) + Need{size}.factors();
}

}  // namespace

uint64_t target_held_bytes(const TargetSize& size) {
    return kProgramBytes + Need{size}.held();
}

uint64_t target_memory_bytes(const TargetSize& size) {
    const Need need{size};
    return std::max(reading_bytes(size, 1),
                    target_held_bytes(size) + std::max(need.floor(), need.searching()));
}

void check_target_memory(const TargetSize& size, uint64_t limit_bytes, const std::string& what) {
    const uint64_t least = target_memory_bytes(size);
    if (least <= limit_bytes) return;
    TargetSize svd = size;
    svd.clusters = false;
    const uint64_t least_of_svd = target_memory_bytes(svd);
    const std::string instead =
        size.clusters && least_of_svd <= limit_bytes
            ? fmt::format(" (--codec svd alone takes {})", memory_text(least_of_svd))
            : "";
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
