// Traced light on a mesh. Light bounces between the vertices, as in the bake (compressor/bake/bounces.h).
#include "analysis/reference/traced_scene.h"

#include <algorithm>
#include <utility>

#include "compressor/bake/direction_sampler.h"
#include "compressor/bake/ray_offset.h"
#include "compressor/bake/transport_row.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

constexpr size_t kPlacesPerPiece = 64;

// Keys of points of triangles differ from those of vertices.
constexpr uint64_t kPointPart = 1;

}  // namespace

std::vector<Vec3f> VertexLight::half(size_t half) const {
    std::vector<Vec3f> sum = terms.front()[half];
    for (size_t b = 1; b < terms.size(); ++b) {
        for (size_t v = 0; v < sum.size(); ++v) sum[v] += terms[b][half][v];
    }
    return sum;
}

// Carries light from vertices to a place.
class TracedScene::Bounces {
  public:
    Bounces(const TracedScene& scene, uint32_t rays)
        : scene_(scene),
          sampler_(make_sampler(SamplerKind::cosine, rays / 4, HalfRelation::independent)) {}

    HitTracer tracer() const {
        return HitTracer(scene_.scene_, scene_.all_.topology, scene_.all_.positions);
    }

    // The vertices that a half of the rays of a place meet.
    void find_row(const Place& place, uint32_t half, HitTracer& tracer, TransportRow& row) const {
        constexpr uint64_t kBouncePart = 4;  // direct light has parts 0 … 3
        const HalfKeys keys{mix_bits(place.key ^ kBouncePart),
                            mix_bits(place.key ^ (kBouncePart + 1))};
        tracer.trace(place.vertex, place.start, place.normal, *sampler_, keys, half);
        tracer.end(row);
    }

  private:
    const TracedScene& scene_;
    std::unique_ptr<DirectionSampler> sampler_;
};

TracedScene::TracedScene(TracedMesh mesh, const TracedMesh& still)
    : all_(std::move(mesh)),
      num_vertices_(all_.topology.num_vertices),
      scene_(all_.topology, all_.positions, still.topology, still.positions),
      starts_(all_.topology, all_.positions, all_.normals),
      offsets_(ray_offsets(all_.topology, all_.positions)) {
    PAIM_CHECK_EQ(all_.positions.size(), all_.normals.size());
    all_.append(still);
}

namespace {

// Albedo times light that bounced b times, of the mesh and after it of the still mesh.
std::vector<Vec3f> outgoing(const Albedo& albedo, const std::vector<Vec3f>& of_mesh,
                            const VertexLight* of_still, size_t b, size_t half) {
    std::vector<Vec3f> out = of_mesh;
    if (of_still != nullptr) {
        const std::vector<Vec3f>& term = of_still->terms[b][half];
        out.insert(out.end(), term.begin(), term.end());
    }
    for (uint32_t v = 0; v < out.size(); ++v) out[v] = out[v].cwiseProduct(albedo.at(v));
    return out;
}

Vec3f carry(const TransportRow& row, const std::vector<Vec3f>& from) {
    Vec3d sum = Vec3d::Zero();
    for (const HitWeight& hit : row) {
        sum += static_cast<double>(hit.weight) * from[hit.vertex].cast<double>();
    }
    return sum.cast<float>();
}

}  // namespace

VertexLight TracedScene::light_vertices(const DirectLight& light, const TraceSettings& settings,
                                        const VertexLight* of_still) const {
    const auto place_of_vertex = [&](size_t v) -> Place {
        return {starts_[v], all_.normals[v], static_cast<uint32_t>(v),
                stream_key(settings.seed, settings.pose, v)};
    };
    const auto new_term = [&] {
        VertexLight::Term term;
        for (auto& half : term) half.assign(num_vertices_, Vec3f::Zero());
        return term;
    };
    VertexLight result;
    result.terms.push_back(new_term());
    parallel_for(num_vertices_, kPlacesPerPiece, [&](size_t begin, size_t end) {
        DirectLight::Workspace work;
        for (size_t v = begin; v < end; ++v) {
            if (all_.normals[v].isZero(0.0f)) continue;
            const Place place = place_of_vertex(v);
            const LightHalves halves = light.at(scene_, place.start, place.normal, place.key, work);
            for (size_t h = 0; h < 2; ++h) result.terms[0][h][v] = halves[h];
        }
    });
    const Bounces bounces(*this, light.rays());
    for (uint32_t b = 1; b <= settings.bounces; ++b) {
        VertexLight::Term term = new_term();
        for (uint32_t half = 0; half < 2; ++half) {
            const std::vector<Vec3f> from =
                outgoing(all_.albedo, result.terms[b - 1][half], of_still, b - 1, half);
            parallel_for(num_vertices_, kPlacesPerPiece, [&](size_t begin, size_t end) {
                TransportRow row;
                for (size_t v = begin; v < end; ++v) {
                    if (all_.normals[v].isZero(0.0f)) continue;
                    HitTracer tracer = bounces.tracer();
                    bounces.find_row(place_of_vertex(v), half, tracer, row);
                    term[half][v] = carry(row, from);
                }
            });
        }
        result.terms.push_back(std::move(term));
    }
    return result;
}

TracedScene::Place TracedScene::place_of(const TracedPoint& point, uint64_t key) const {
    const SurfacePoint place = surface_point(all_, offsets_, point);
    return {{place.origin, nullptr}, place.normal, all_.topology.triangles[point.triangle][0], key};
}

std::vector<LightHalves> TracedScene::light_points(std::span<const TracedPoint> points,
                                                   const DirectLight& light,
                                                   const TraceSettings& settings,
                                                   const VertexLight& of_mesh,
                                                   const VertexLight* of_still) const {
    const Bounces bounces(*this, light.rays());
    // [bounces][half]
    std::vector<std::array<std::vector<Vec3f>, 2>> from(settings.bounces);
    for (uint32_t b = 0; b < settings.bounces; ++b) {
        for (size_t half = 0; half < 2; ++half) {
            from[b][half] = outgoing(all_.albedo, of_mesh.terms[b][half], of_still, b, half);
        }
    }
    std::vector<LightHalves> result(points.size(), LightHalves{Vec3f::Zero(), Vec3f::Zero()});
    parallel_for(points.size(), kPlacesPerPiece, [&](size_t begin, size_t end) {
        DirectLight::Workspace work;
        TransportRow row;
        for (size_t j = begin; j < end; ++j) {
            const Place place =
                place_of(points[j], stream_key(settings.seed, settings.pose, j, kPointPart));
            if (place.normal.isZero(0.0f)) continue;
            result[j] = light.at(scene_, place.start, place.normal, place.key, work);
            for (uint32_t half = 0; half < 2 && settings.bounces > 0; ++half) {
                HitTracer tracer = bounces.tracer();
                bounces.find_row(place, half, tracer, row);
                for (const auto& halves : from) result[j][half] += carry(row, halves[half]);
            }
        }
    });
    return result;
}

}  // namespace paim
