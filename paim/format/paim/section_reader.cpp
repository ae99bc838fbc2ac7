// Reads the sections of a .paim into an asset.
#include "paim/format/paim/section_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"
#include "paim/format/paim/row_predictors.h"
#include "paim/format/paim/section_table.h"
#include "paim/format/paim/value_limits.h"
#include "paim/format/paim/value_reader.h"

namespace paim {

namespace {

// A row of the table, and the section of the file that has its values.
struct FoundRow {
    TableRow row;
    const Section* section;
};

Precision precision_of(ScalarType type) {
    switch (type) {
        case ScalarType::i8:
            return Precision::i8;
        case ScalarType::i16:
            return Precision::i16;
        case ScalarType::f16:
            return Precision::f16;
        default:
            return Precision::f32;
    }
}

// The types that a row may have in a file.
struct AllowedTypes {
    using Types = std::vector<ScalarType>;
    Types operator()(Topology*) const { return {ScalarType::u32}; }
    Types operator()(const SingularValues&) const { return {ScalarType::f64, ScalarType::f32}; }
    Types operator()(const Weights&) const { return {ScalarType::f32, ScalarType::i16}; }
    Types operator()(const MatrixValues&) const { return kValues; }
    Types operator()(StoredValues*) const { return kValues; }
    Types operator()(const SmallNumbers&) const { return {ScalarType::i16}; }
    Types operator()(const VertexNumbers&) const { return {ScalarType::u32}; }
    Types operator()(const TextureValues& values) const { return {values.type}; }
    Types operator()(RootMotion*) const { return {ScalarType::f64}; }
    template <typename Row>
    Types operator()(const Row&) const {
        return {ScalarType::f32};
    }

  private:
    inline static const Types kValues{ScalarType::f32, ScalarType::f16, ScalarType::i16,
                                      ScalarType::i8};
};

// Finds a row's section and checks its type and shape.
const Section& find_section(const ContainerReader& reader, const TableRow& row) {
    const Section* const section = reader.find(row.tag, row.index);
    if (section == nullptr) {
        throw_bad_input("{}: section {} {} is missing", reader.name(), row.tag.str(), row.index);
    }
    const std::vector<ScalarType> types = std::visit(AllowedTypes(), row.values);
    if (std::find(types.begin(), types.end(), section->spec.type) == types.end()) {
        if (types.size() == 1) reader.require(row.tag, types[0], row.index);  // throws
        throw_unsupported("{}: values of {}", reader.label(*section),
                          scalar_name(section->spec.type));
    }
    const auto& shape = section->spec.shape;
    const bool fits = (row.shape[0] == kAnySize || shape[1] == row.shape[0]) &&
                      (row.shape[1] == kAnySize || shape[2] == row.shape[1]);
    if (shape[0] != 1 || !fits) {
        const auto size = [](uint32_t n) { return n == kAnySize ? "any" : std::to_string(n); };
        throw_bad_input("{}: {} x {} x {} values, expected {} x {}", reader.label(*section),
                        shape[0], shape[1], shape[2], size(row.shape[0]), size(row.shape[1]));
    }
    return *section;
}

// Whether the values that a row of steps belongs to are integers in the file.
bool goes_with_integers(const std::vector<FoundRow>& found, const TableRow& steps) {
    const auto* const of_values = std::get_if<Steps>(&steps.values);
    return std::any_of(found.begin(), found.end(), [&](const FoundRow& other) {
        const bool integers = is_integer(precision_of(other.section->spec.type));
        if (of_values != nullptr) {
            const auto* values = std::get_if<MatrixValues>(&other.row.values);
            return integers && values != nullptr && values->matrix == of_values->matrix;
        }
        const auto* weights = std::get_if<Weights>(&other.row.values);
        return integers && weights != nullptr &&
               weights->matrix == std::get<WeightSteps>(steps.values).matrix;
    });
}

bool is_steps(const TableRow& row) {
    return std::holds_alternative<Steps>(row.values) ||
           std::holds_alternative<WeightSteps>(row.values);
}

// Marks the sizes that only the file knows.
void open_shape(TableRow& row) {
    if (std::holds_alternative<Topology*>(row.values)) row.shape[0] = kAnySize;
    if (std::holds_alternative<Albedo*>(row.values)) row.shape[0] = kAnySize;
    if (std::holds_alternative<SingularValues>(row.values)) row.shape[1] = kAnySize;
}

// All rows of the file, checked. Rows of steps are among them only if their values are integers.
std::vector<FoundRow> find_rows(const ContainerReader& reader, Asset& asset) {
    std::vector<FoundRow> found;
    std::vector<TableRow> steps;
    for (TableRow& row : section_table(asset)) {
        open_shape(row);
        if (is_steps(row)) {
            steps.push_back(std::move(row));
        } else {
            const Section& section = find_section(reader, row);
            found.push_back({std::move(row), &section});
        }
    }
    std::vector<FoundRow> with_steps;
    for (TableRow& row : steps) {
        if (goes_with_integers(found, row)) {
            const Section& section = find_section(reader, row);
            with_steps.push_back({std::move(row), &section});
        }
    }
    // Steps come first, because weights are multiplied by theirs when they are read.
    with_steps.insert(with_steps.end(), std::make_move_iterator(found.begin()),
                      std::make_move_iterator(found.end()));
    return with_steps;
}

// Sets the precision of matrices. Mean and components are all integers or all floats (checked); the
// mean of half floats is of floats.
void set_precisions(const ContainerReader& reader, const std::vector<FoundRow>& found) {
    for (const FoundRow& mean : found) {
        const auto* const of_mean = std::get_if<MatrixValues>(&mean.row.values);
        if (of_mean == nullptr || of_mean->is_component) continue;
        LowRank& matrix = *of_mean->matrix;
        matrix.precision = precision_of(mean.section->spec.type);
        for (const FoundRow& other : found) {
            const auto* const values = std::get_if<MatrixValues>(&other.row.values);
            if (values == nullptr || values->matrix != &matrix || !values->is_component) continue;
            const Precision precision = precision_of(other.section->spec.type);
            if (is_integer(precision) != is_integer(matrix.precision)) {
                throw_unsupported("{}: {}, where others are not", reader.label(*other.section),
                                  scalar_name(other.section->spec.type));
            }
            if (other.row.index == 0) matrix.precision = precision;  // the one with most bits
        }
    }
}

// Predictors of the integers of a file.
// Error (bad input) if the file is too small for so many vertices. A predictor takes many bytes a
// vertex, while sections may claim few.
RowPredictors make_predictors(const ContainerReader& reader, const Asset& asset) {
    const bool predicted =
        std::any_of(reader.sections().begin(), reader.sections().end(),
                    [](const Section& s) { return s.codec == SectionCodec::planes; });
    if (!predicted) return RowPredictors(asset.num_poses());
    const uint64_t most =
        most_bytes_of_values(reader.file_size_bytes()) / PlanePredictor::kBytesAVertex;
    for (const CodedMesh& mesh : asset.parts) {
        if (mesh.topology.num_vertices <= most) continue;
        throw_bad_input("{}: {} vertices, expected at most {} in a file of {} bytes", reader.name(),
                        mesh.topology.num_vertices, most, reader.file_size_bytes());
    }
    return RowPredictors(asset);
}

// Reads a row. Arrays of values are only listed here, and read together afterwards.
struct RowReader {
    const ContainerReader& reader;
    const Section& section;
    const TableRow& row;
    const RowPredictors& predictors;
    std::vector<ValueJob>& jobs;

    void operator()(Topology*) const {}  // read before all other rows
    void operator()(Albedo*) const {}
    void operator()(const VertexNumbers&) const {}
    void operator()(const TextureValues&) const {}
    void operator()(const SingularValues& values) const {
        std::vector<double>& out = values.matrix->singular_values;
        if (section.spec.type == ScalarType::f32) {
            const std::vector<float> rounded = reader.read_f32(section);
            out.assign(rounded.begin(), rounded.end());
        } else {
            out = reader.read_f64(section);
        }
    }
    void operator()(const Weights& values) const {
        LowRank& matrix = *values.matrix;
        if (section.spec.type == ScalarType::i16) {
            const StoredValues integers = read_values(reader, section, predictors.of(row));
            matrix.weights.resize(integers.size());
            integers.widen(0, matrix.weights);
            for (size_t j = 0; j < matrix.weights.size(); ++j) {
                matrix.weights[j] *= matrix.weight_steps[j / matrix.num_poses];
            }
        } else {
            matrix.weights = reader.read_f32(section);
        }
        check_finite(reader, row.tag, matrix.weights);
    }
    void operator()(const WeightSteps& values) const {
        values.matrix->weight_steps = read_steps(reader, section);
    }
    void operator()(const Steps& values) const {
        values.matrix->steps = read_steps(reader, section);
    }
    void operator()(const MatrixValues& values) const { add(values.values); }
    void operator()(StoredValues* values) const { add(values); }
    void operator()(const SmallNumbers& numbers) const {
        const StoredValues values = read_values(reader, section, predictors.of(row));
        numbers.values->resize(values.size());
        values.for_each(0, values.size(), [&](size_t j, float number) {
            if (!(number >= 0.0f && number < static_cast<float>(numbers.below))) {
                throw_bad_input("{}: value {} is {}, expected 0 to {}", reader.label(section), j,
                                number, numbers.below - 1);
            }
            (*numbers.values)[j] = static_cast<uint32_t>(number);
        });
    }
    void operator()(std::vector<float>* values) const {
        *values = reader.read_f32(section);
        check_finite(reader, row.tag, *values);
    }
    void operator()(RootMotion* motion) const {
        *motion = root_motion_of(reader.read_f64(section), reader.label(section));
    }

  private:
    void add(StoredValues* out) const {
        PAIM_CHECK(out != nullptr);
        jobs.push_back({&section, &predictors.of(row), out});
    }
};

// Error (bad input) unless the numbers are different ones below num_vertices.
void read_vertex_numbers(const ContainerReader& reader, const Section& section,
                         const VertexNumbers& numbers) {
    *numbers.values = reader.read_u32(section);
    std::vector<bool> is_named(numbers.num_vertices, false);
    for (const uint32_t v : *numbers.values) {
        if (v >= numbers.num_vertices || is_named[v]) {
            throw_bad_input("{}: vertex {}, expected different ones from 0 to {}",
                            reader.label(section), v, int64_t{numbers.num_vertices} - 1);
        }
        is_named[v] = true;
    }
}

// Error (bad input) unless they are 0 … 1.
void check_tints(const ContainerReader& reader, Tag tag, const Albedo& tints) {
    for (const Vec3f& tint : tints.values) {
        if (tint.minCoeff() >= 0.0f && tint.maxCoeff() <= 1.0f) continue;
        throw_bad_input("{}: section {}: a tint of {}, {}, {}, expected 0 to 1", reader.name(),
                        tag.str(), tint.x(), tint.y(), tint.z());
    }
}

// Error (bad input) if a frame turns by more than π about an axis.
void check_turns(const ContainerReader& reader, const CodedMesh& mesh) {
    if (!mesh.gloss) return;
    for (const float radians : mesh.gloss->frame_turns.mean_floats()) {
        if (std::abs(radians) <= 3.15f) continue;
        throw_bad_input("{}: a frame of gloss turns by {} radians, expected at most pi",
                        reader.name(), radians);
    }
}

void read_meshes(const ContainerReader& reader, const std::vector<FoundRow>& found, Asset& asset) {
    for (const FoundRow& row : found) {
        CodedMesh& mesh = asset.parts[row.row.part];
        if (std::holds_alternative<Topology*>(row.row.values)) {
            mesh.topology = read_triangles(reader, mesh.topology.num_vertices, row.row.tag);
        } else if (const auto* colours = std::get_if<Albedo*>(&row.row.values)) {
            const bool of_rows = mesh.gloss && *colours == &mesh.gloss->tint;
            **colours = read_albedo(
                reader, of_rows ? mesh.gloss->num_rows : mesh.topology.num_vertices, row.row.tag);
            if (of_rows) check_tints(reader, row.row.tag, **colours);
        } else if (const auto* numbers = std::get_if<VertexNumbers>(&row.row.values)) {
            read_vertex_numbers(reader, *row.section, *numbers);
        }
    }
    for (size_t part = 0; part < asset.parts.size(); ++part) {
        CodedMesh& mesh = asset.parts[part];
        mesh.texture = read_texture(reader, mesh.topology, section::kTexture[part]);
    }
}

bool is_wanted(const FoundRow& found) {
    const auto* const values = std::get_if<MatrixValues>(&found.row.values);
    return values == nullptr || !values->is_component ||
           found.row.index < values->matrix->num_components;
}

}  // namespace

void read_sections(const ContainerReader& reader, const ComponentCounts& counts, Asset& asset) {
    CodedMesh& moving = asset.moving();
    const std::vector<Attribute> attributes = moving.attributes();
    for (const Attribute which : attributes) {
        LowRank& matrix = moving.attribute(which);
        matrix.components.resize(matrix.num_components);
    }
    std::vector<FoundRow> found = find_rows(reader, asset);
    set_precisions(reader, found);
    read_meshes(reader, found, asset);
    const RowPredictors predictors = make_predictors(reader, asset);

    // Arrays of the same type and shape are put together, so that many are read at once.
    std::vector<ValueJob> jobs;
    const auto read = [&](bool components) {
        for (const FoundRow& row : found) {
            const auto* const values = std::get_if<MatrixValues>(&row.row.values);
            const bool is_component = values != nullptr && values->is_component;
            if (is_component != components || !is_wanted(row)) continue;
            std::visit(RowReader{reader, *row.section, row.row, predictors, jobs}, row.row.values);
        }
    };
    read(false);
    for (const Attribute which : attributes) {
        check_singular_values(reader, moving.attribute(which));
        moving.attribute(which).keep_components(counts[static_cast<size_t>(which)]);
    }
    read(true);
    std::stable_sort(jobs.begin(), jobs.end(), [](const ValueJob& a, const ValueJob& b) {
        return std::pair(a.section->spec.tag.text, a.section->spec.index) <
               std::pair(b.section->spec.tag.text, b.section->spec.index);
    });
    read_values(reader, jobs);
    check_smoothing(reader, moving.positions);
    smooth_stored(moving.positions, moving.topology);
    for (const CodedMesh& mesh : asset.parts) {
        check_turns(reader, mesh);
        check_magnitudes(mesh, reader.name() + ": ");
    }
}

}  // namespace paim
