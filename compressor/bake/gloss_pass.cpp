// The glossy transfer of a pose, from the rays that its diffuse transfer is made of.
#include "compressor/bake/gloss_pass.h"

#include <algorithm>

#include "compressor/bake/gloss_estimate.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

constexpr size_t kGlossRowsPerPiece = 32;

// One vertex at a time; each thread needs its own.
class VertexGloss {
  public:
    VertexGloss(const PoseRays& rays, const TransferLayout& layout, const sh::BatchBasis& basis)
        : rays_(rays), sums_(basis, layout), bands_(std::max(layout.in_bands, layout.out_bands)) {}

    // estimates  [O · C] of each half
    void estimate(uint32_t v, const GlossReflection& reflection, float c,
                  std::array<std::vector<double>, 2>& estimates) {
        const VertexFrame frame(static_cast<int>(bands_), rays_.pose.normals[v]);
        const RayStart start = rays_.starts[v];
        for (uint32_t half = 0; half < 2; ++half) {
            sums_.start(reflection, frame);
            rays_.rounds.for_each(
                v, [&](const DirectionSampler& sampler, const HalfKeys& keys, double weight) {
                    sampler.generate(rays_.pose.normals[v], keys, half, directions_);
                    trace(v, start);
                    for (float& factor : factors_) factor = 1.0f - factor - c;
                    sums_.add(directions_, factors_, sampler.num_points(), weight);
                });
            sums_.estimate(static_cast<double>(c), estimates[half]);
        }
    }

  private:
    // factors_ become 1 for occluded rays and 0 for others.
    void trace(uint32_t v, const RayStart& start) {
        factors_.assign(directions_.weights.size(), 0.0f);
        const uint64_t num_occluded = rays_.num_occluded[v];
        if (num_occluded == rays_.num_rays[v]) {
            std::fill(factors_.begin(), factors_.end(), 1.0f);
        } else if (num_occluded > 0) {
            occluded_from(rays_.scene, start, directions_.x.data(), directions_.y.data(),
                          directions_.z.data(), directions_.num_rays, factors_.data());
        }
    }

    const PoseRays& rays_;
    GlossSums sums_;
    const uint32_t bands_;
    RaySet directions_;
    std::vector<float> factors_;
};

}  // namespace

GlossRows::GlossRows(const Topology& topology, const Materials& materials,
                     const GlossReflections& all)
    : vertices(materials.empty() ? std::vector<uint32_t>() : glossy_rows(topology, materials)) {
    for (const uint32_t v : vertices) {
        const uint16_t material = materials.at(v);
        reflections.push_back(material == 0 ? nullptr
                                            : &all.of(materials.glossy[material - 1u].brdf));
        tints.push_back(material == 0 ? Vec3f(Vec3f::Ones())
                                      : materials.glossy[material - 1u].tint);
    }
}

std::array<std::vector<float>, 2> estimate_gloss(const PoseRays& rays, const GlossRows& rows,
                                                 const TransferLayout& layout,
                                                 const sh::BatchBasis& basis) {
    const size_t num_rows = rows.vertices.size();
    const size_t num_values = size_t{layout.num_outgoing()} * layout.num_coefficients();
    std::array<std::vector<float>, 2> halves;
    for (auto& half : halves) half.resize(num_values * num_rows, 0.0f);
    parallel_for(num_rows, kGlossRowsPerPiece, [&](size_t begin, size_t end) {
        VertexGloss gloss(rays, layout, basis);
        std::array<std::vector<double>, 2> estimates;
        for (auto& estimate : estimates) estimate.resize(num_values);
        for (size_t r = begin; r < end; ++r) {
            const uint32_t v = rows.vertices[r];
            if (rows.reflections[r] == nullptr || !rays.has_normal(v)) continue;
            const auto c = static_cast<float>(rays.open_around[v]);
            gloss.estimate(v, *rows.reflections[r], c, estimates);
            for (size_t half = 0; half < 2; ++half) {
                for (size_t value = 0; value < num_values; ++value) {
                    halves[half][value * num_rows + r] = static_cast<float>(estimates[half][value]);
                }
            }
        }
    });
    return halves;
}

}  // namespace paim
