// The light that all vertices of a scene send out, after some number of bounces.
#include "compressor/bake/sent_light.h"

#include <algorithm>

#include "paim/sh/basis.h"

namespace paim {

SentLight::SentLight(const TransferLayout& layout, const TransferLayout& gloss_layout)
    : layout_(layout),
      gloss_layout_(gloss_layout),
      num_light_(std::max(layout.num_coefficients(), gloss_layout.num_coefficients())) {}

void SentLight::reserve(size_t num_vertices, size_t num_rows) {
    row_of_.reserve(num_vertices);
    diffuse_.reserve(num_vertices * layout_.num_planes());
    gloss_.reserve(num_rows * gloss_layout_.num_planes());
}

void SentLight::add(const ReflectingMesh& mesh, const GlossyTerm& term, size_t half) {
    const size_t num_coefficients = layout_.num_coefficients();
    const std::vector<float>& diffuse = term.diffuse[half];
    const size_t first_vertex = row_of_.size();
    row_of_.resize(first_vertex + mesh.num_vertices, kMatte);
    for (uint32_t v = 0; v < mesh.num_vertices; ++v) {
        for (uint32_t channel = 0; channel < layout_.channels; ++channel) {
            const float albedo = mesh.albedo->at(v)[channel];
            const float* const from =
                diffuse.data() + (channel * mesh.num_vertices + v) * num_coefficients;
            for (size_t i = 0; i < num_coefficients; ++i) diffuse_.push_back(albedo * from[i]);
        }
    }
    const size_t num_values =
        size_t{gloss_layout_.num_outgoing()} * gloss_layout_.num_coefficients();
    const size_t of_row = num_values * gloss_layout_.channels;
    const GlossRows& rows = *mesh.rows;
    for (size_t r = 0; r < rows.vertices.size(); ++r) {
        if (rows.reflections[r] == nullptr) continue;
        row_of_[first_vertex + rows.vertices[r]] = static_cast<uint32_t>(gloss_.size() / of_row);
        for (uint32_t channel = 0; channel < gloss_layout_.channels; ++channel) {
            const float tint = rows.tints[r][channel];
            const float* const from =
                term.gloss[half].data() + (channel * rows.vertices.size() + r) * num_values;
            for (size_t value = 0; value < num_values; ++value)
                gloss_.push_back(tint * from[value]);
        }
    }
}

void SentLight::at(const SurfaceHit& hit, const Vec3d& direction, std::span<float> radiance) const {
    std::fill(radiance.begin(), radiance.end(), 0.0f);
    float of_direction[sh::num_coefficients(ExitFunctions::kMaxBands)];
    const std::span basis(of_direction, gloss_layout_.num_outgoing());
    sh::evaluate_basis(static_cast<int>(gloss_layout_.out_bands), direction, basis);
    const size_t num_diffuse = layout_.num_coefficients();
    const size_t num_gloss = gloss_layout_.num_coefficients();
    for (uint32_t corner = 0; corner < hit.num_corners; ++corner) {
        const uint32_t v = hit.vertices[corner];
        const float weight = hit.weights[corner];
        const float* diffuse = diffuse_.data() + size_t{v} * layout_.channels * num_diffuse;
        for (uint32_t channel = 0; channel < layout_.channels; ++channel) {
            float* const to = radiance.data() + channel * num_light_;
            for (size_t i = 0; i < num_diffuse; ++i) to[i] += weight * *diffuse++;
        }
        if (row_of_[v] == kMatte) continue;
        const float* gloss =
            gloss_.data() + size_t{row_of_[v]} * layout_.channels * basis.size() * num_gloss;
        for (uint32_t channel = 0; channel < layout_.channels; ++channel) {
            float* const to = radiance.data() + channel * num_light_;
            for (const float y : basis) {
                const float factor = weight * y;
                for (size_t i = 0; i < num_gloss; ++i) to[i] += factor * gloss[i];
                gloss += num_gloss;
            }
        }
    }
}

}  // namespace paim
