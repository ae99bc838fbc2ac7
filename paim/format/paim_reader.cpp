// Reads .paim files.
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/error.h"
#include "paim/format/mesh_sections.h"
#include "paim/format/metadata.h"
#include "paim/format/paim_file.h"
#include "paim/format/paim_sections.h"
#include "paim/format/scenery_sections.h"

namespace paim {

namespace {

// Error unless the section has this shape.
void expect_shape(const ContainerReader& reader, const Section& section, uint32_t rows,
                  uint32_t columns) {
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || shape[1] != rows || shape[2] != columns) {
        throw_bad_input("{}: section {} {}: {} x {} x {} values, expected {} x {}", reader.path(),
                        section.spec.tag.str(), section.spec.index, shape[0], shape[1], shape[2],
                        rows, columns);
    }
}

void read_spectrum(const ContainerReader& reader, size_t i, LowRankMatrix& matrix) {
    matrix.singular_values =
        reader.read_f64(reader.require(section::kSpectrum[i], ScalarType::f64));
    double previous = std::numeric_limits<double>::infinity();
    for (const double s : matrix.singular_values) {
        if (!(s >= 0.0 && s <= previous && std::isfinite(s))) {
            throw_bad_input("{}: singular values: expected finite, descending numbers, got {}",
                            reader.path(), s);
        }
        previous = s;
    }
    if (matrix.singular_values.size() < matrix.num_components) {
        throw_bad_input("{}: {} singular values, expected at least the {} components'",
                        reader.path(), matrix.singular_values.size(), matrix.num_components);
    }
}

void read_matrix(const ContainerReader& reader, Part part, LowRankMatrix& matrix) {
    const auto i = static_cast<size_t>(part);
    const Section& mean = reader.require(section::kMean[i], ScalarType::f32);
    expect_shape(reader, mean, matrix.num_planes, matrix.num_points);
    std::vector<float> mean_values = reader.read_f32(mean);
    check_finite(reader, section::kMean[i], mean_values);
    matrix.mean = std::move(mean_values);

    const Section& weights = reader.require(section::kWeights[i], ScalarType::f32);
    expect_shape(reader, weights, matrix.num_components, matrix.num_poses);
    matrix.weights = reader.read_f32(weights);
    check_finite(reader, section::kWeights[i], matrix.weights);
    read_spectrum(reader, i, matrix);

    // Every component's shape is checked before memory for all of them is taken: together they are
    // no larger than the file.
    std::vector<const Section*> sections(matrix.num_components);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        sections[k] = reader.find(section::kComponent[i], k);
        if (sections[k] == nullptr) {
            throw_bad_input("{}: section {} {} is missing", reader.path(),
                            section::kComponent[i].str(), k);
        }
        const ScalarType type = sections[k]->spec.type;
        if (type != ScalarType::f32 && type != ScalarType::f16) {
            throw_unsupported("{}: components of {}", reader.path(), scalar_name(type));
        }
        expect_shape(reader, *sections[k], matrix.num_planes, matrix.num_points);
        matrix.precision = type == ScalarType::f16 ? Precision::f16 : Precision::f32;
    }
    matrix.components.reserve(matrix.num_components);
    for (const Section* section : sections) {
        std::vector<float> values = reader.read_f32(*section);
        check_finite(reader, section::kComponent[i], values);
        matrix.components.emplace_back(std::move(values));
    }
}

}  // namespace

Model read_paim(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path)) {
        throw_bad_input(
            "{}: is a directory, expected a .paim file (paim-compress encode makes one of a "
            ".bake)",
            path.string());
    }
    const ContainerReader reader(path, section::kKindAnimation);
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

    const auto start = [&](const char* key, uint32_t num_planes) {
        LowRankMatrix matrix;
        matrix.num_points = num_vertices;
        matrix.num_planes = num_planes;
        matrix.num_poses = num_poses;
        // No matrix has more components than columns or rows.
        const uint64_t most = std::min<uint64_t>(num_poses, matrix.num_rows());
        matrix.num_components = metadata.integer(key, 0, static_cast<uint32_t>(most));
        return matrix;
    };
    model.geometry = start("geometry_components", 3);
    model.transfer = start("transfer_components", model.layout.num_planes());
    read_matrix(reader, Part::geometry, model.geometry);
    read_matrix(reader, Part::transfer, model.transfer);
    model.scenery = read_scenery(reader, model.layout);
    return model;
}

}  // namespace paim
