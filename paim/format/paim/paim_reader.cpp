// Reads .paim files.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "paim/base/error.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/metadata.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/matrix_sections.h"
#include "paim/format/paim/paim_file.h"
#include "paim/format/paim/paim_metadata.h"
#include "paim/format/paim/prefixes.h"
#include "paim/format/paim/scenery_sections.h"

namespace paim {

namespace {

// The longest playable prefix that is there. Error (bad input) if there is none.
Prefix find_prefix(const ContainerReader& reader) {
    const std::vector<Prefix> prefixes = list_prefixes(reader);
    const auto next = std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& prefix) {
        return prefix.size_bytes > reader.file_size_bytes();
    });
    if (next == prefixes.begin()) {
        throw_bad_input("{}: cut short: {} bytes, expected at least the {} that can be played",
                        reader.path(), reader.file_size_bytes(), next->size_bytes);
    }
    return *std::prev(next);
}

}  // namespace

Model read_paim(const std::filesystem::path& path, const ReadOptions& options) {
    if (std::filesystem::is_directory(path)) {
        throw_bad_input(
            "{}: is a directory, expected a .paim file (paim-compress encode makes one of a "
            ".bake)",
            path.string());
    }
    const ContainerReader reader(path, section::kKindAnimation,
                                 options.progressive ? Extent::prefix : Extent::whole);
    const Prefix prefix = find_prefix(reader);
    const Metadata metadata(reader.read_text(reader.require(section::kMetadata, ScalarType::u8)),
                            reader.path());
    Model model;
    const auto num_vertices =
        metadata.integer("num_vertices", 0, std::numeric_limits<int32_t>::max());
    const uint32_t num_poses = metadata.integer("num_poses", 1, kMaxPoses);
    model.layout.bands = metadata.integer("bands", 1, sh::kMaxBands);
    model.layout.channels = metadata.integer("channels", 1, 3);
    if (model.layout.channels == 2) throw_unsupported("{}: 2 transfer channels", reader.path());
    if (metadata.text("transfer_kind") != "diffuse") {
        throw_unsupported("{}: transfer of kind '{}'", reader.path(),
                          metadata.text("transfer_kind"));
    }
    model.frames_per_second = static_cast<float>(metadata.number("frames_per_second", 1e-3, 1e6));
    model.origin = metadata.point("origin");
    model.name = metadata.text("name");
    model.provenance_json = metadata.object_text("provenance");
    model.topology = read_triangles(reader, num_vertices);
    model.albedo = read_albedo(reader, num_vertices);

    if (metadata.root().contains("vertex_order")) {
        if (metadata.text("vertex_order") != "local") {
            throw_unsupported("{}: vertices in '{}' order", reader.path(),
                              metadata.text("vertex_order"));
        }
        model.vertex_order = VertexOrder::cache;
    }
    if (metadata.root().contains("clusters")) {
        model.clusters.num_clusters = metadata.integer("clusters", 1, kMaxClusters);
        model.clusters.num_components =
            metadata.integer("cluster_components", 0, kMaxClusterComponents);
    }

    const auto start = [&](const char* key, uint32_t num_points, uint32_t num_planes) {
        LowRankMatrix matrix;
        matrix.num_points = num_points;
        matrix.num_planes = num_planes;
        matrix.num_poses = num_poses;
        // No matrix has more components than columns or rows.
        const uint64_t most = std::min<uint64_t>(num_poses, matrix.num_rows());
        matrix.num_components = metadata.integer(key, 0, static_cast<uint32_t>(most));
        return matrix;
    };
    const bool clustered = !model.clusters.empty();
    model.geometry = start("geometry_components", num_vertices, 3);
    model.transfer =
        start("transfer_components", clustered ? model.clusters.num_rows() : num_vertices,
              model.layout.num_planes());
    // Memory for every vertex is taken once the file is known to claim values for it.
    const Section* mean = reader.find(section::kMean[0]);
    if (mean == nullptr) {
        throw_bad_input("{}: section {} 0 is missing", reader.path(), section::kMean[0].str());
    }
    expect_shape(reader, *mean, 3, num_vertices);
    const PlanePredictor predictor = read_predictor(reader, model.topology);
    const uint32_t geometry_components = model.geometry.num_components;
    const uint32_t transfer_components = model.transfer.num_components;
    read_matrix(reader, Attribute::geometry, predictor, prefix.geometry_components, model.geometry);
    if (clustered) read_clusters(reader, predictor, num_vertices, model.clusters);
    read_matrix(reader, Attribute::transfer, clustered ? PlanePredictor() : predictor,
                prefix.transfer_components, model.transfer);
    const auto index = [&](Attribute attribute, uint32_t num_components, LowRankMatrix& matrix) {
        matrix.singular_indices = read_singular_indices(metadata, attribute, num_components,
                                                        matrix.singular_values.size());
        // Those that are there.
        if (!matrix.singular_indices.empty()) {
            matrix.singular_indices.resize(matrix.num_components);
        }
    };
    index(Attribute::geometry, geometry_components, model.geometry);
    index(Attribute::transfer, transfer_components, model.transfer);
    model.complete = model.geometry.num_components == geometry_components &&
                     model.transfer.num_components == transfer_components;
    model.scenery = read_scenery(reader, model.layout);
    return model;
}

}  // namespace paim
