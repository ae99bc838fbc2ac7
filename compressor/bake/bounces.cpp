// Light that bounces before it reaches a vertex.
// Based on: Sloan, Kautz and Snyder 2002; Goral, Torrance, Greenberg and Battaile 1984 (see the
//           header)
#include "compressor/bake/bounces.h"

#include <algorithm>
#include <atomic>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

constexpr size_t kRowsPerPiece = 64;

// Keeps rows up to a number of bytes, and makes the others again whenever they are needed.
class RowCache {
  public:
    RowCache(const BounceScene& scene, uint64_t max_bytes) : scene_(scene) {
        for (size_t half = 0; half < 2; ++half) {
            rows_[half].resize(scene.num_vertices);
            is_kept_[half].resize(scene.num_vertices, 0);
        }
        std::atomic<uint64_t> used{0};
        parallel_for(scene.num_vertices, kRowsPerPiece, [&](size_t begin, size_t end) {
            TransportRow row;
            for (size_t v = begin; v < end; ++v) {
                for (size_t half = 0; half < 2; ++half) {
                    // Which rows are kept may differ from run to run, their values do not.
                    if (used.load() >= max_bytes) return;
                    scene.make_row(v, half, row);
                    used += row.size() * sizeof(HitWeight);
                    rows_[half][v].assign(row.begin(), row.end());
                    is_kept_[half][v] = 1;
                }
            }
        });
    }

    const TransportRow& row(size_t v, size_t half, TransportRow& scratch) const {
        if (is_kept_[half][v]) return rows_[half][v];
        scene_.make_row(v, half, scratch);
        return scratch;
    }

  private:
    const BounceScene& scene_;
    std::vector<TransportRow> rows_[2];
    std::vector<uint8_t> is_kept_[2];
};

// Albedo times transfer of all vertices, [channels][V + S][C].
void outgoing(const BounceScene& scene, const std::vector<float>& own,
              const std::vector<float>* still_mesh, std::vector<float>& out) {
    const size_t num_coefficients = scene.layout.num_coefficients();
    size_t to = 0;
    const auto append = [&](const std::vector<float>& term, const Albedo& albedo, size_t count,
                            uint32_t channel) {
        const float* from = term.data() + channel * count * num_coefficients;
        for (uint32_t v = 0; v < count; ++v) {
            const float rho = albedo.at(v)[channel];
            for (size_t i = 0; i < num_coefficients; ++i) out[to++] = rho * *from++;
        }
    };
    for (uint32_t channel = 0; channel < scene.layout.channels; ++channel) {
        append(own, scene.albedo, scene.num_vertices, channel);
        if (still_mesh) append(*still_mesh, scene.still_albedo, scene.num_still_vertices, channel);
    }
}

// Sums weight · values over the hits of a row.
// values  [V + S][C]
// sums    [C]
void sum_hits(const TransportRow& row, const float* values, std::vector<double>& sums) {
    std::fill(sums.begin(), sums.end(), 0.0);
    for (const HitWeight& hit : row) {
        const float* of_hit = values + hit.vertex * sums.size();
        const auto weight = static_cast<double>(hit.weight);
        for (size_t i = 0; i < sums.size(); ++i) {
            sums[i] += weight * static_cast<double>(of_hit[i]);
        }
    }
}

// Gathers the outgoing light at all vertices by their rows.
// source  [channels][V + S][C]
// use     is called with (channel, v, i, value), by several threads for different vertices
template <typename Use>
void gather(const BounceScene& scene, const RowCache& rows, size_t half,
            const std::vector<float>& source, const Use& use) {
    const size_t num_coefficients = scene.layout.num_coefficients();
    const size_t of_channel = (scene.num_vertices + scene.num_still_vertices) * num_coefficients;
    parallel_for(scene.num_vertices, kRowsPerPiece, [&](size_t begin, size_t end) {
        TransportRow scratch;
        std::vector<double> sums(num_coefficients);
        for (size_t v = begin; v < end; ++v) {
            const TransportRow& row = rows.row(v, half, scratch);
            for (size_t channel = 0; channel < scene.layout.channels; ++channel) {
                sum_hits(row, source.data() + channel * of_channel, sums);
                for (size_t i = 0; i < num_coefficients; ++i) {
                    use(channel, v, i, static_cast<float>(sums[i]));
                }
            }
        }
    });
}

}  // namespace

BounceTerms add_bounces(const BounceScene& scene, uint32_t num_bounces,
                        std::array<std::vector<float>, 2>& halves, bool keep_terms,
                        uint64_t max_row_bytes) {
    const size_t num_vertices = scene.num_vertices;
    const size_t num_coefficients = scene.layout.num_coefficients();
    const size_t num_channels = scene.layout.channels;
    const size_t num_all = num_vertices + scene.num_still_vertices;
    const size_t num_sums = num_channels * num_coefficients;
    if (scene.num_still_vertices > 0) PAIM_CHECK_LE(num_bounces, scene.still_terms->size());
    BounceTerm term;
    for (size_t half = 0; half < 2; ++half) {
        std::vector<float>& total = halves[half];
        PAIM_CHECK_EQ(total.size(), num_coefficients * num_vertices);
        term[half].resize(num_sums * num_vertices);
        for (size_t channel = 0; channel < num_channels; ++channel) {
            for (size_t v = 0; v < num_vertices; ++v) {
                for (size_t i = 0; i < num_coefficients; ++i) {
                    term[half][(channel * num_vertices + v) * num_coefficients + i] =
                        total[i * num_vertices + v];
                }
            }
        }
        total.resize(num_sums * num_vertices);
        for (size_t channel = 1; channel < num_channels; ++channel) {
            const auto grey = static_cast<std::ptrdiff_t>(num_coefficients * num_vertices);
            std::copy_n(total.begin(), grey,
                        total.begin() + static_cast<std::ptrdiff_t>(channel) * grey);
        }
    }

    const RowCache rows(scene, max_row_bytes);
    BounceTerms terms;
    std::vector<float> source(num_all * num_sums);
    for (uint32_t b = 1; b <= num_bounces; ++b) {
        if (keep_terms) terms.push_back(term);
        for (size_t half = 0; half < 2; ++half) {
            const bool has_still_mesh = scene.num_still_vertices > 0;
            outgoing(scene, term[half],
                     has_still_mesh ? &(*scene.still_terms)[b - 1][half] : nullptr, source);
            gather(scene, rows, half, source, [&](size_t channel, size_t v, size_t i, float value) {
                term[half][(channel * num_vertices + v) * num_coefficients + i] = value;
                halves[half][(channel * num_coefficients + i) * num_vertices + v] += value;
            });
        }
    }
    return terms;
}

bool is_coloured(const Albedo& albedo) {
    return std::any_of(albedo.values.begin(), albedo.values.end(), [](const Vec3f& value) {
        return value.x() != value.y() || value.y() != value.z();
    });
}

}  // namespace paim
