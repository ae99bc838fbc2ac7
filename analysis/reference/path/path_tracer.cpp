// Light that leaves points of glossy and diffuse surfaces, by tracing paths.
// Based on: Kajiya 1986; Veach and Guibas 1995 (see the header)
#include "analysis/reference/path/path_tracer.h"

#include <cmath>
#include <optional>
#include <utility>

#include "compressor/bake/ray_offset.h"
#include "paim/base/check.h"
#include "paim/base/orthonormal_basis.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

constexpr size_t kStartsPerPiece = 16;

// Random numbers of a place on a path: a direction by the light and one by the reflection.
struct PathNumbers {
    double light_u, light_v, reflection_u, reflection_v;
};

// Axes of the interpolated normal.
class Frame {
  public:
    explicit Frame(const Vec3f& normal) {
        Vec3f x, y;
        orthonormal_basis(normal, x, y);
        axes_.col(0) = x.cast<double>();
        axes_.col(1) = y.cast<double>();
        axes_.col(2) = normal.cast<double>();
    }

    Vec3d to_local(const Vec3d& v) const { return axes_.transpose() * v; }
    Vec3d to_scene(const Vec3d& v) const { return axes_ * v; }

  private:
    Eigen::Matrix3d axes_;
};

// The numbers of a path's first place are points of a net, scrambled for each batch.
class FirstNumbers {
  public:
    FirstNumbers(const SobolPoints& net, uint64_t key) : net_(net) {
        for (size_t j = 0; j < 4; ++j) seeds_[j] = static_cast<uint32_t>(mix_bits(key ^ j));
    }

    PathNumbers operator[](size_t path) const {
        const auto fraction = [&](const std::vector<uint32_t>& coordinates, size_t seed) {
            return static_cast<double>(scrambled_fraction(coordinates[path], seeds_[seed]));
        };
        return {fraction(net_.reversed_x, 0), fraction(net_.reversed_y, 1),
                fraction(net_.reversed_x, 2), fraction(net_.reversed_y, 3)};
    }

  private:
    const SobolPoints& net_;
    uint32_t seeds_[4];
};

}  // namespace

// One path, from the eye to the light.
class PathTracer::Walk {
  public:
    Walk(const PathTracer& tracer, const PathStart& start, const PathSettings& settings)
        : tracer_(tracer),
          point_(start.point),
          out_(start.out.cast<double>()),
          kinds_(settings.seen),
          bounces_(settings.bounces) {}

    Vec3d run(PathNumbers numbers, RandomStream& random) {
        for (uint32_t bounce = 0; step(numbers) && bounce < bounces_; ++bounce) {
            numbers = {random.uniform(), random.uniform(), random.uniform(), random.uniform()};
            kinds_ = {};
        }
        return sum_;
    }

  private:
    // Adds the light that arrives at the point from outside, and goes to what the point sees. False
    // if the path ends.
    bool step(const PathNumbers& numbers) {
        const SurfacePoint place = surface_point(tracer_.mesh_, tracer_.offsets_, point_);
        if (place.normal.isZero(0.0f)) return false;
        const PathReflection reflection(tracer_.materials_, tracer_.mesh_.albedo,
                                        tracer_.mesh_.topology.triangles[point_.triangle],
                                        {1.0f - point_.u - point_.v, point_.u, point_.v}, kinds_);
        if (reflection.is_black()) return false;
        const Frame frame(place.normal);
        Vec3d out = frame.to_local(out_);
        out.z() = std::abs(out.z());
        add_light(place, frame, reflection, out, numbers);
        return follow(place, frame, reflection, out, numbers);
    }

    // Light from a direction that the light chose.
    void add_light(const SurfacePoint& place, const Frame& frame, const PathReflection& reflection,
                   const Vec3d& out, const PathNumbers& numbers) {
        const auto light = tracer_.light_.sample(numbers.light_u, numbers.light_v);
        if (!light) return;
        const Vec3d in = frame.to_local(light->direction);
        if (!(in.z() > 0.0)) return;
        const Vec3d weight =
            in.z() * reflection.value(in, out) / (light->density + reflection.density(in, out));
        if (weight.isZero(0.0) || first_hit(place, light->direction)) return;
        sum_ += factor_.cwiseProduct(weight).cwiseProduct(light->radiance);
    }

    // Light from a direction that the reflection chose; if the ray meets a surface, the path goes on
    // there.
    bool follow(const SurfacePoint& place, const Frame& frame, const PathReflection& reflection,
                const Vec3d& out, const PathNumbers& numbers) {
        const Vec3d in = reflection.sample(out, numbers.reflection_u, numbers.reflection_v);
        if (!(in.z() > 0.0)) return false;
        const double density = reflection.density(in, out);
        const Vec3d reflected = in.z() * reflection.value(in, out);
        if (!(density > 0.0) || reflected.isZero(0.0)) return false;
        const Vec3d direction = frame.to_scene(in);
        const auto hit = first_hit(place, direction);
        if (!hit) {
            const Vec3d weight = reflected / (density + tracer_.light_.density(direction));
            sum_ += factor_.cwiseProduct(weight).cwiseProduct(tracer_.light_.radiance(direction));
            return false;
        }
        if (is_back(*hit, direction)) return false;
        factor_ = factor_.cwiseProduct(reflected / density);
        point_ = {hit->triangle, hit->u, hit->v};
        out_ = -direction;
        return true;
    }

    std::optional<Hit> first_hit(const SurfacePoint& place, const Vec3d& direction) const {
        return tracer_.scene_.intersect_first(place.origin, direction.cast<float>());
    }

    bool is_back(const Hit& hit, const Vec3d& direction) const {
        const Triangle& t = tracer_.mesh_.topology.triangles[hit.triangle];
        const auto corner = [&](size_t c) -> Vec3d {
            return tracer_.mesh_.positions[t[c]].cast<double>();
        };
        return (corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(direction) > 0.0;
    }

    const PathTracer& tracer_;
    TracedPoint point_;
    Vec3d out_;  // unit, from the point to where its light goes
    PathKinds kinds_;
    const uint32_t bounces_;
    Vec3d factor_ = Vec3d::Ones();  // what light from the point is multiplied by
    Vec3d sum_ = Vec3d::Zero();
};

PathTracer::PathTracer(TracedMesh mesh, const PathMaterials& materials, const PathLight& light)
    : mesh_(std::move(mesh)),
      materials_(materials),
      light_(light),
      scene_(mesh_.topology, mesh_.positions),
      offsets_(ray_offsets(mesh_.topology, mesh_.positions)) {
    PAIM_CHECK_EQ(materials.materials.glossy.size(), materials.brdfs.size());
    PAIM_CHECK_EQ(mesh_.normals.size(), mesh_.positions.size());
}

std::vector<PathEstimate> PathTracer::trace(std::span<const PathStart> starts,
                                            const PathSettings& settings) const {
    PAIM_CHECK_LE(2u, settings.batches);
    PAIM_CHECK_LE(1u, settings.paths);
    const SobolPoints net(settings.paths);
    std::vector<PathEstimate> estimates(starts.size());
    parallel_for(starts.size(), kStartsPerPiece, [&](size_t begin, size_t end) {
        for (size_t j = begin; j < end; ++j) {
            Vec3d sum = Vec3d::Zero(), squares = Vec3d::Zero();
            for (uint32_t batch = 0; batch < settings.batches; ++batch) {
                const uint64_t key = stream_key(settings.seed, batch, j);
                const FirstNumbers first(net, key);
                RandomStream random(stream_key(settings.seed, batch, j, 1));
                Vec3d of_batch = Vec3d::Zero();
                for (uint32_t path = 0; path < settings.paths; ++path) {
                    of_batch += Walk(*this, starts[j], settings).run(first[path], random);
                }
                of_batch /= settings.paths;
                sum += of_batch;
                squares += of_batch.cwiseAbs2();
            }
            const double n = settings.batches;
            const Vec3d mean = sum / n;
            const Vec3d variance = (squares / n - mean.cwiseAbs2()).cwiseMax(0.0) / (n - 1.0);
            estimates[j] = {mean.cast<float>(), variance.cwiseSqrt().cast<float>()};
        }
    });
    return estimates;
}

}  // namespace paim
