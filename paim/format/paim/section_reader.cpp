// Reads the sections of a .paim into an asset.
#include "paim/format/paim/section_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/plane_decoder.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/format/paim/section_table.h"

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

// Decodes integers of sections of the same type and shape, several at once.
// out  [sections]
template <typename Integer>
void read_integers(const ContainerReader& reader, std::span<const Section* const> sections,
                   const PlanePredictor& predictor, WorkspacePool& pool, StoredValues* out) {
    std::vector<std::vector<uint8_t>> stored;
    std::vector<std::vector<Integer>> values;
    std::vector<StoredPlanes<Integer>> planes;
    for (const Section* section : sections) {
        if (section->codec != SectionCodec::planes) {
            throw_unsupported("{}: codec {} for integers", reader.label(*section),
                              static_cast<int>(section->codec));
        }
        stored.push_back(reader.read_stored(*section));
        values.emplace_back(section->spec.num_values());
        planes.push_back({stored.back(), section->spec.shape[1], values.back()});
    }
    WorkspacePool::Lease workspace(pool);
    const auto good = [&](std::span<const StoredPlanes<Integer>> some) {
        return some[0].num_planes > 0 && decode_planes(some, predictor, *workspace);
    };
    if (!good(planes)) {
        const auto bad = std::find_if(planes.begin(), planes.end(), [&](const auto& section) {
            return !good(std::span(&section, 1));
        });
        PAIM_CHECK(bad != planes.end());
        const Section& section = *sections[static_cast<size_t>(bad - planes.begin())];
        throw_bad_input("{}: holds no {} planes of {} integers", reader.label(section),
                        section.spec.shape[1], section.spec.shape[2]);
    }
    std::move(values.begin(), values.end(), out);
}

// Reads integers, or finite floats (checked), of sections of the same type and shape.
// out  [sections]
void read_alike(const ContainerReader& reader, std::span<const Section* const> sections,
                const PlanePredictor& predictor, WorkspacePool& pool, StoredValues* out) {
    switch (sections[0]->spec.type) {
        case ScalarType::i8:
            return read_integers<int8_t>(reader, sections, predictor, pool, out);
        case ScalarType::i16:
            return read_integers<int16_t>(reader, sections, predictor, pool, out);
        case ScalarType::f16:
        case ScalarType::f32:
            for (const Section* section : sections) {
                std::vector<float> values = reader.read_f32(*section);
                check_finite(reader, section->spec.tag, values);
                *out++ = std::move(values);
            }
            return;
        default:
            throw_unsupported("{}: values of {}", reader.label(*sections[0]),
                              scalar_name(sections[0]->spec.type));
    }
}

// Number of planes of this type that are decoded fastest at once.
size_t planes_at_once(ScalarType type) {
    return type == ScalarType::i8    ? kPlanesAtOnce<int8_t>
           : type == ScalarType::i16 ? kPlanesAtOnce<int16_t>
                                     : 1;
}

// An array of values to read, with the predictor of its integers.
struct Job {
    const Section* section;
    const PlanePredictor* predictor;
    StoredValues* out;
};

bool are_alike(const Job& a, const Job& b) {
    return a.predictor == b.predictor && a.section->spec.type == b.section->spec.type &&
           a.section->spec.shape == b.section->spec.shape;
}

// Reads all arrays on all threads; arrays of the same type and shape are read together. The result
// is the same on any number of threads.
void read_values(const ContainerReader& reader, std::span<const Job> jobs) {
    std::vector<size_t> ends{0};  // of the groups of arrays that are read together
    for (size_t j = 1; j < jobs.size(); ++j) {
        const SectionSpec& spec = jobs[j].section->spec;
        const size_t num_planes = (j + 1 - ends.back()) * spec.shape[1];
        if (!are_alike(jobs[j], jobs[j - 1]) || num_planes > planes_at_once(spec.type)) {
            ends.push_back(j);
        }
    }
    if (!jobs.empty()) ends.push_back(jobs.size());
    WorkspacePool pool;
    parallel_for(ends.size() - 1, 1, [&](size_t j, size_t) {
        const auto some = jobs.subspan(ends[j], ends[j + 1] - ends[j]);
        std::vector<const Section*> sections;
        for (const Job& job : some) sections.push_back(job.section);
        std::vector<StoredValues> values(some.size());
        read_alike(reader, sections, *some[0].predictor, pool, values.data());
        for (size_t i = 0; i < some.size(); ++i) *some[i].out = std::move(values[i]);
    });
}

StoredValues read_values(const ContainerReader& reader, const Section& section,
                         const PlanePredictor& predictor) {
    StoredValues values;
    const Job job{&section, &predictor, &values};
    read_values(reader, std::span(&job, 1));
    return values;
}

// Reads steps of integers. Each is at least 0, and 2¹⁵ times it is finite (checked).
std::vector<float> read_steps(const ContainerReader& reader, const Section& section) {
    std::vector<float> steps = reader.read_f32(section);
    for (const float step : steps) {
        if (!(step >= 0.0f && step <= kMaxStep)) {
            throw_bad_input("{}: steps: expected numbers from 0 to {:.3g}, got {}",
                            reader.label(section), kMaxStep, step);
        }
    }
    return steps;
}

void check_singular_values(const ContainerReader& reader, const LowRank& matrix) {
    double previous = std::numeric_limits<double>::infinity();
    for (const double s : matrix.singular_values) {
        if (!(s >= 0.0 && s <= previous && std::isfinite(s))) {
            throw_bad_input("{}: singular values: expected finite, descending numbers, got {}",
                            reader.name(), s);
        }
        previous = s;
    }
    if (matrix.singular_values.size() < matrix.num_components) {
        throw_bad_input("{}: {} singular values, expected at least the {} components'",
                        reader.name(), matrix.singular_values.size(), matrix.num_components);
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

// Error (bad input) if the file is too small for so many vertices. The predictor takes many bytes a
// vertex, while sections may claim few.
PlanePredictor make_predictor(const ContainerReader& reader, const Topology& topology) {
    const uint64_t most =
        most_bytes_of_values(reader.file_size_bytes()) / PlanePredictor::kBytesAVertex;
    if (topology.num_vertices > most) {
        throw_bad_input("{}: {} vertices, expected at most {} in a file of {} bytes", reader.name(),
                        topology.num_vertices, most, reader.file_size_bytes());
    }
    return PlanePredictor(topology);
}

// Predictors of the integers of a file; none if no section is predicted.
class Predictors {
  public:
    Predictors(const ContainerReader& reader, const Asset& asset)
        : poses_(PlanePredictor::chain(asset.num_poses())), vertices_(asset.parts.size()) {
        const bool predicted =
            std::any_of(reader.sections().begin(), reader.sections().end(),
                        [](const Section& s) { return s.codec == SectionCodec::planes; });
        if (!predicted) return;
        for (size_t j = 0; j < asset.parts.size(); ++j) {
            vertices_[j] = make_predictor(reader, asset.parts[j].topology);
        }
    }

    const PlanePredictor& of(const TableRow& row) const {
        switch (row.neighbours) {
            case Neighbours::vertices:
                return vertices_[row.part];
            case Neighbours::poses:
                return poses_;
            case Neighbours::none:
                break;
        }
        return none_;
    }

  private:
    PlanePredictor poses_;
    std::vector<PlanePredictor> vertices_;
    PlanePredictor none_;
};

// Reads a row. Arrays of values are only listed here, and read together afterwards.
struct RowReader {
    const ContainerReader& reader;
    const Section& section;
    const TableRow& row;
    const Predictors& predictors;
    std::vector<Job>& jobs;

    void operator()(Topology*) const {}  // read before all other rows
    void operator()(Albedo*) const {}
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

  private:
    void add(StoredValues* out) const {
        PAIM_CHECK(out != nullptr);
        jobs.push_back({&section, &predictors.of(row), out});
    }
};

void read_meshes(const ContainerReader& reader, const std::vector<FoundRow>& found, Asset& asset) {
    for (const FoundRow& row : found) {
        CodedMesh& mesh = asset.parts[row.row.part];
        if (std::holds_alternative<Topology*>(row.row.values)) {
            mesh.topology = read_triangles(reader, mesh.topology.num_vertices, row.row.tag);
        } else if (std::holds_alternative<Albedo*>(row.row.values)) {
            mesh.albedo = read_albedo(reader, mesh.topology.num_vertices, row.row.tag);
        }
    }
}

bool is_wanted(const FoundRow& found) {
    const auto* const values = std::get_if<MatrixValues>(&found.row.values);
    return values == nullptr || !values->is_component ||
           found.row.index < values->matrix->num_components;
}

// Error (bad input) if decoded values could overflow in any pose with any number of components.
void check_magnitudes(const ContainerReader& reader, const CodedMesh& mesh) {
    constexpr double kMax = std::numeric_limits<float>::max();
    const auto check = [&](const char* what, const LowRank& matrix, double gain) {
        for (const double bound : magnitude_bounds(matrix)) {
            if (!(bound <= kMax && bound * gain <= kMax)) {
                throw_bad_input(
                    "{}: {}: means, components and weights decode to numbers of up to {:.3g}, "
                    "expected at most {:.3g}",
                    reader.name(), what, bound * gain, kMax);
            }
        }
    };
    check("positions", mesh.positions, 1.0);
    check("transfer", mesh.transfer->matrix, mesh.transfer->vertex_gain());
}

}  // namespace

void read_sections(const ContainerReader& reader, const ComponentCounts& counts, Asset& asset) {
    LowRank* const matrices[] = {&asset.moving().positions, &asset.moving().transfer->matrix};
    for (LowRank* matrix : matrices) matrix->components.resize(matrix->num_components);
    std::vector<FoundRow> found = find_rows(reader, asset);
    set_precisions(reader, found);
    read_meshes(reader, found, asset);
    const Predictors predictors(reader, asset);

    // Arrays of the same type and shape are put together, so that many are read at once.
    std::vector<Job> jobs;
    const auto read = [&](bool components) {
        for (const FoundRow& row : found) {
            const auto* const values = std::get_if<MatrixValues>(&row.row.values);
            const bool is_component = values != nullptr && values->is_component;
            if (is_component != components || !is_wanted(row)) continue;
            std::visit(RowReader{reader, *row.section, row.row, predictors, jobs}, row.row.values);
        }
    };
    read(false);
    for (const LowRank* matrix : matrices) check_singular_values(reader, *matrix);
    matrices[0]->keep_components(counts.geometry);
    matrices[1]->keep_components(counts.transfer);
    read(true);
    std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
        return std::pair(a.section->spec.tag.text, a.section->spec.index) <
               std::pair(b.section->spec.tag.text, b.section->spec.index);
    });
    read_values(reader, jobs);
    for (const CodedMesh& mesh : asset.parts) check_magnitudes(reader, mesh);
}

}  // namespace paim
