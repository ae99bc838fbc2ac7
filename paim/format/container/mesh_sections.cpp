// Reads triangles, albedo and planes from sections.
#include "paim/format/container/mesh_sections.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "paim/base/error.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/index_decoder.h"

namespace paim {

Topology read_triangles(const ContainerReader& reader, uint32_t num_vertices, Tag tag) {
    const Section& section = reader.require(tag, ScalarType::u32);
    if (section.spec.shape[0] != 1 || section.spec.shape[2] != 3) {
        throw_bad_input("{}: triangles: expected 3 indices each, got {}", reader.name(),
                        section.spec.shape[2]);
    }
    Topology topology{num_vertices, std::vector<Triangle>(section.spec.shape[1])};
    if (section.codec == SectionCodec::indices) {
        if (!decode_triangles(reader.read_stored(section), topology.triangles)) {
            throw_bad_input("{}: holds no {} encoded triangles", reader.label(section),
                            topology.triangles.size());
        }
    } else if (!topology.triangles.empty()) {
        const std::vector<uint32_t> indices = reader.read_u32(section);
        std::memcpy(topology.triangles.data(), indices.data(), indices.size() * sizeof(uint32_t));
    }
    for (size_t i = 0; i < topology.triangles.size(); ++i) {
        for (const uint32_t v : topology.triangles[i]) {
            if (v >= num_vertices) {
                throw_bad_input("{}: triangle {}: vertex {}, expected 0 to {}", reader.name(), i, v,
                                int64_t{num_vertices} - 1);
            }
        }
    }
    return topology;
}

Albedo read_albedo(const ContainerReader& reader, uint32_t num_vertices, Tag tag) {
    const Section& section = reader.require(tag, ScalarType::f32);
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || (shape[1] != 1 && shape[1] != num_vertices) || shape[2] != 3) {
        throw_bad_input("{}: albedo: {} x {} x {} values, expected 1 or {} colours", reader.name(),
                        shape[0], shape[1], shape[2], num_vertices);
    }
    const std::vector<float> values = reader.read_f32(section);
    check_finite(reader, tag, values);
    Albedo albedo;
    albedo.values.resize(shape[1]);
    for (size_t i = 0; i < albedo.values.size(); ++i) {
        albedo.values[i] = Vec3f(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
    return albedo;
}

std::vector<float> read_planes(const ContainerReader& reader, Tag tag, uint32_t num_planes,
                               uint32_t num_vertices, ScalarType type) {
    const Section& section = reader.require(tag, type);
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || shape[1] != num_planes || shape[2] != num_vertices) {
        throw_bad_input("{}: section {}: {} x {} x {} values, expected {} x {}", reader.name(),
                        tag.str(), shape[0], shape[1], shape[2], num_planes, num_vertices);
    }
    std::vector<float> values = reader.read_f32(section);
    check_finite(reader, tag, values);
    return values;
}

uint32_t count_vertices(const ContainerReader& reader, Tag tag) {
    const Section* section = reader.find(tag);
    if (section == nullptr) {
        throw_bad_input("{}: section {} 0 is missing", reader.name(), tag.str());
    }
    const uint32_t count = section->spec.shape[2];
    constexpr uint32_t kMax = std::numeric_limits<int32_t>::max();
    if (count < 1 || count > kMax) {
        throw_bad_input("{}: section {}: {} vertices, expected 1 to {}", reader.name(), tag.str(),
                        count, kMax);
    }
    return count;
}

void check_finite(const ContainerReader& reader, Tag tag, std::span<const float> values,
                  uint64_t first) {
    const auto bad =
        std::find_if(values.begin(), values.end(), [](float x) { return !std::isfinite(x); });
    if (bad != values.end()) {
        throw_bad_input("{}: section {}: value {} is {}, expected a finite number", reader.name(),
                        tag.str(), first + static_cast<uint64_t>(bad - values.begin()), *bad);
    }
}

}  // namespace paim
