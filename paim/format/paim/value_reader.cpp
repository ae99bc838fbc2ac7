// Reads arrays of a matrix's values: integers of planes, or floats.
#include "paim/format/paim/value_reader.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/pack/plane_decoder.h"

namespace paim {

namespace {

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

bool are_alike(const ValueJob& a, const ValueJob& b) {
    return a.predictor == b.predictor && a.section->spec.type == b.section->spec.type &&
           a.section->spec.shape == b.section->spec.shape;
}

}  // namespace

void read_values(const ContainerReader& reader, std::span<const ValueJob> jobs) {
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
        for (const ValueJob& job : some) sections.push_back(job.section);
        std::vector<StoredValues> values(some.size());
        read_alike(reader, sections, *some[0].predictor, pool, values.data());
        for (size_t i = 0; i < some.size(); ++i) *some[i].out = std::move(values[i]);
    });
}

StoredValues read_values(const ContainerReader& reader, const Section& section,
                         const PlanePredictor& predictor) {
    StoredValues values;
    const ValueJob job{&section, &predictor, &values};
    read_values(reader, std::span(&job, 1));
    return values;
}

}  // namespace paim
