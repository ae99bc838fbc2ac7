// Light that bounces where some vertices are glossy.
// Based on: Sloan, Kautz and Snyder 2002 (see the header)
#include "compressor/bake/glossy_bounces.h"

#include <algorithm>
#include <numeric>

#include "compressor/bake/vertex_frame.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

constexpr size_t kGatheredPerPiece = 32;
constexpr uint32_t kNoRow = ~uint32_t{0};

// Gathers the light that reaches one vertex by the rays of one half. Each thread needs its own.
class HitGatherer {
  public:
    explicit HitGatherer(const GlossyBounceScene& scene)
        : scene_(scene),
          hits_(scene.rays.scene, scene.topology, scene.positions),
          num_gloss_(scene.gloss_layout.num_coefficients()) {}

    // reflection  nullptr: matte
    void gather(uint32_t v, uint32_t half, const GlossReflection* reflection,
                const SentLight& source) {
        const uint32_t channels = scene_.layout.channels;
        const size_t num_rows = reflection ? reflection->functions.coefficients().size() : 0;
        diffuse_.assign(channels * scene_.layout.num_coefficients(), 0.0);
        rows_.assign(channels * num_rows * num_gloss_, 0.0);
        exit_.resize(num_rows * ExitFunctions::kBatch);
        radiance_.resize(channels * source.num_light());
        gloss_.assign(channels * scene_.gloss_layout.num_outgoing() * num_gloss_, 0.0);
        if (scene_.rays.num_occluded[v] == 0) return;
        const Vec3f& normal = scene_.rays.pose.normals[v];
        const VertexFrame frame(static_cast<int>(scene_.gloss_layout.out_bands), normal);
        const RayStart start = scene_.rays.starts[v];
        double num_points = 0.0;
        scene_.rays.rounds.for_each(
            v, [&](const DirectionSampler& sampler, const HalfKeys& keys, double weight) {
                hits_.trace(v, start, normal, sampler, keys, half);
                num_points += weight * sampler.num_points();
                add_hits(weight, reflection, frame, source);
            });
        for (double& sum : diffuse_) sum /= num_points;
        for (double& sum : rows_) sum *= kPi / num_points;
        if (reflection == nullptr) return;
        for (uint32_t channel = 0; channel < channels; ++channel) {
            const size_t of_channel = scene_.gloss_layout.num_outgoing() * num_gloss_;
            frame.rows_to_pose(reflection->functions.coefficients(), num_gloss_,
                               rows_.data() + channel * num_rows * num_gloss_,
                               gloss_.data() + channel * of_channel);
        }
    }

    const std::vector<double>& diffuse() const { return diffuse_; }  // [channels][C]
    const std::vector<double>& gloss() const { return gloss_; }      // [channels][O][C']
    uint32_t num_back_hits() const { return hits_.num_back_hits(); }

  private:
    void add_hits(double round_weight, const GlossReflection* reflection, const VertexFrame& frame,
                  const SentLight& source) {
        const RaySet& rays = hits_.rays();
        size_t packet = ~size_t{0};
        for (const SurfaceHit& hit : hits_.hits()) {
            const Vec3d direction =
                Vec3f(rays.x[hit.ray], rays.y[hit.ray], rays.z[hit.ray]).cast<double>();
            source.at(hit, -direction, radiance_);
            const double weight = round_weight * static_cast<double>(rays.weights[hit.ray]);
            add_diffuse(weight, source.num_light());
            if (reflection == nullptr) continue;
            if (hit.ray / ExitFunctions::kBatch != packet) {
                packet = hit.ray / ExitFunctions::kBatch;
                float x[ExitFunctions::kBatch], y[ExitFunctions::kBatch], z[ExitFunctions::kBatch];
                frame.directions_to_frame(rays, packet * ExitFunctions::kBatch, x, y, z);
                reflection->functions.evaluate(x, y, z, exit_.data());
            }
            add_gloss(weight, hit.ray % ExitFunctions::kBatch, source.num_light());
        }
    }

    void add_diffuse(double weight, size_t num_light) {
        const size_t num_coefficients = scene_.layout.num_coefficients();
        double* to = diffuse_.data();
        for (uint32_t channel = 0; channel < scene_.layout.channels; ++channel) {
            const float* const from = radiance_.data() + channel * num_light;
            for (size_t i = 0; i < num_coefficients; ++i) {
                *to++ += weight * static_cast<double>(from[i]);
            }
        }
    }

    void add_gloss(double weight, size_t lane, size_t num_light) {
        const size_t num_rows = exit_.size() / ExitFunctions::kBatch;
        double* to = rows_.data();
        for (uint32_t channel = 0; channel < scene_.layout.channels; ++channel) {
            const float* const from = radiance_.data() + channel * num_light;
            for (size_t row = 0; row < num_rows; ++row) {
                const double factor =
                    weight * static_cast<double>(exit_[row * ExitFunctions::kBatch + lane]);
                for (size_t i = 0; i < num_gloss_; ++i) {
                    to[i] += factor * static_cast<double>(from[i]);
                }
                to += num_gloss_;
            }
        }
    }

    const GlossyBounceScene& scene_;
    SurfaceHits hits_;
    const size_t num_gloss_;  // C'
    std::vector<double> diffuse_, gloss_;
    std::vector<double> rows_;  // [channels][K][C']
    std::vector<float> exit_;   // [K][16]
    std::vector<float> radiance_;
};

// [n][count] of one channel as [channels][count][n], and the same repeated in every channel.
std::vector<float> first_term(std::vector<float>& planes, size_t count, uint32_t channels) {
    const size_t of_channel = planes.size();
    const size_t n = count == 0 ? 0 : of_channel / count;
    std::vector<float> term(channels * of_channel);
    for (size_t channel = 0; channel < channels; ++channel) {
        for (size_t v = 0; v < count; ++v) {
            for (size_t i = 0; i < n; ++i) {
                term[channel * of_channel + v * n + i] = planes[i * count + v];
            }
        }
    }
    planes.resize(channels * of_channel);
    for (size_t channel = 1; channel < channels; ++channel) {
        std::copy_n(planes.begin(), of_channel,
                    planes.begin() + static_cast<ptrdiff_t>(channel * of_channel));
    }
    return term;
}

// Writes [channels][n] of one vertex or row into a term, and adds it to the planes.
void put(const std::vector<double>& values, size_t at, size_t count, uint32_t channels,
         std::vector<float>& term, std::vector<float>& planes) {
    const size_t n = values.size() / channels;
    for (size_t channel = 0; channel < channels; ++channel) {
        for (size_t i = 0; i < n; ++i) {
            const auto value = static_cast<float>(values[channel * n + i]);
            term[(channel * count + at) * n + i] = value;
            planes[(channel * n + i) * count + at] += value;
        }
    }
}

}  // namespace

std::vector<GlossyTerm> add_glossy_bounces(const GlossyBounceScene& scene, uint32_t num_bounces,
                                           std::array<std::vector<float>, 2>& halves,
                                           std::array<std::vector<float>, 2>& gloss,
                                           bool keep_terms, uint64_t& num_back_hits) {
    PAIM_CHECK_EQ(scene.layout.channels, scene.gloss_layout.channels);
    const uint32_t channels = scene.layout.channels;
    const GlossRows& rows = *scene.own.rows;
    const size_t num_vertices = scene.own.num_vertices, num_rows = rows.vertices.size();
    const size_t still_rows =
        scene.still_mesh.num_vertices > 0 ? scene.still_mesh.rows->vertices.size() : 0;
    std::vector<uint32_t> row_of(num_vertices, kNoRow);
    for (size_t r = 0; r < num_rows; ++r) row_of[rows.vertices[r]] = static_cast<uint32_t>(r);
    GlossyTerm term;
    for (size_t half = 0; half < 2; ++half) {
        term.diffuse[half] = first_term(halves[half], num_vertices, channels);
        term.gloss[half] = first_term(gloss[half], num_rows, channels);
    }
    std::vector<GlossyTerm> terms;
    for (uint32_t b = 1; b <= num_bounces; ++b) {
        if (keep_terms) terms.push_back(term);
        for (uint32_t half = 0; half < 2; ++half) {
            SentLight source(scene.layout, scene.gloss_layout);
            source.reserve(num_vertices + scene.still_mesh.num_vertices, num_rows + still_rows);
            source.add(scene.own, term, half);
            if (scene.still_mesh.num_vertices > 0) {
                source.add(scene.still_mesh, (*scene.still_terms)[b - 1], half);
            }
            std::vector<uint64_t> back_hits(num_vertices / kGatheredPerPiece + 1, 0);
            parallel_for(num_vertices, kGatheredPerPiece, [&](size_t begin, size_t end) {
                HitGatherer gatherer(scene);
                for (size_t v = begin; v < end; ++v) {
                    const uint32_t row = row_of[v];
                    gatherer.gather(static_cast<uint32_t>(v), half,
                                    row == kNoRow ? nullptr : rows.reflections[row], source);
                    put(gatherer.diffuse(), v, num_vertices, channels, term.diffuse[half],
                        halves[half]);
                    if (row == kNoRow) continue;
                    put(gatherer.gloss(), row, num_rows, channels, term.gloss[half], gloss[half]);
                }
                back_hits[begin / kGatheredPerPiece] = gatherer.num_back_hits();
            });
            if (b > 1) continue;
            num_back_hits = std::accumulate(back_hits.begin(), back_hits.end(), num_back_hits);
        }
    }
    return terms;
}

}  // namespace paim
