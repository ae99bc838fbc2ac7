// Where the difference between a .paim and the traced truth comes from.
#include "analysis/budget/error_budget.h"

#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "analysis/file_poses.h"
#include "analysis/reference/transfer_truth.h"
#include "analysis/scratch_encode.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

using Radiance = std::vector<std::vector<Vec3f>>;  // [lights][V + S]

// The links of the chain, in this order; the first one is the truth.
constexpr struct {
    const char* name;
    const char* meaning;
    const char* cure;
} kCauses[] = {
    {"interpolation", "light is traced at vertices and interpolated over triangles",
     "more vertices"},
    {"bands", "light and transfer have a limited number of bands", "bake --bands"},
    {"noise", "transfer is baked with a limited number of rays", "bake --rays"},
    {"transfer truncation",
     "transfer has a limited number of components, which also takes noise out", "--max-error"},
    {"transfer coding", "transfer is quantised, and whatever else its codec does", "--max-error"},
    {"geometry truncation", "positions have a limited number of components", "--geometry-error"},
    {"geometry coding", "positions are quantised", "--geometry-error"},
};
constexpr size_t kPixelStep = 1;  // the truth is a step, too

// Whether noise was left in the file's components, as the file says; if it does not, as is usual.
NoiseTreatment noise_treatment(const Asset& file) {
    if (file.provenance_json.empty()) return NoiseTreatment::shrink;
    const auto provenance = nlohmann::json::parse(file.provenance_json);
    const bool keeps = provenance.contains("noise") && provenance["noise"] == "keep";
    return keeps ? NoiseTreatment::keep : NoiseTreatment::shrink;
}

// The components that the file has, as floats.
Asset encode_truncated(const BakeReader& bake, const Asset& file,
                       const std::filesystem::path& scratch) {
    EncodeOptions options;
    options.geometry = {ComponentChoice::Kind::number, file.moving().positions.num_components};
    options.transfer = {ComponentChoice::Kind::number,
                        file.moving().transfer->matrix.num_components};
    options.bands = file.moving().layout.in_bands;
    options.noise = noise_treatment(file);
    return encode_in_memory(bake, options, scratch);
}

class Chain {
  public:
    Chain(const BakeReader& bake, const Asset& file, const Stage& stage, uint32_t rays,
          const std::filesystem::path& scratch, const std::function<void()>& on_step)
        : bake_(bake),
          stage_(stage),
          on_step_(on_step),
          file_poses_(file, bake),
          truncated_(encode_truncated(bake, file, scratch)),
          truncated_poses_(truncated_, bake),
          bands_(file.moving().layout.in_bands),
          truth_(bake),
          pixels_(make_reference(ReferenceKind::traced_pixels, rays, bake, stage)),
          vertices_(make_reference(ReferenceKind::traced, rays, bake, stage)),
          pixel_noise_(stage.lights().size()),
          vertex_noise_(stage.lights().size()) {}

    uint32_t transfer_rays() const { return truth_.rays(); }
    std::vector<double> pixel_noise() const { return pixel_noise_.relative(); }
    std::vector<double> vertex_noise() const { return vertex_noise_.relative(); }

    // Calls link(pictures) for the truth and after each cause.
    template <typename Link>
    void follow(uint32_t p, const Link& link) {
        const auto step = [&](std::vector<Image> pictures) {
            link(std::move(pictures));
            on_step_();
        };
        DecodedPose baked = baked_pose(bake_, p, bake_.read_pose(p));
        const std::vector<VisiblePoints> visible = stage_.look(stage_.place(baked));
        step(traced(pixels_, p, baked, pixel_noise_));
        step(traced(vertices_, p, baked, vertex_noise_));
        DecodedPose truth = truth_.pose(p);
        keep_bands(truth, bands_);
        const DecodedPose* const true_still = truth_.still();
        step(stage_.draw(visible, stage_.light(truth, true_still)));
        keep_bands(baked, bands_);
        step(stage_.draw(visible, stage_.light(baked)));
        const DecodedPose truncated = truncated_poses_.pose(p);
        step(stage_.draw(visible, stage_.light(truncated)));
        const DecodedPose file = file_poses_.pose(p);
        const DecodedPose* const still = file_poses_.still();
        const Radiance lit = stage_.light(file, still);
        step(stage_.draw(visible, lit));
        step(stage_.draw(stage_.look(stage_.place(truncated)), lit));
        step(stage_.draw(stage_.look(stage_.place(file, still)), lit));
    }

  private:
    static std::vector<Image> traced(const Reference& reference, uint32_t p,
                                     const DecodedPose& baked, RelativeNoise& noise) {
        ReferencePictures pictures = reference.source(p, baked);
        noise.add(pictures);
        return std::move(pictures.pictures);
    }

    const BakeReader& bake_;
    const Stage& stage_;
    const std::function<void()>& on_step_;
    FilePoses file_poses_;
    const Asset truncated_;
    FilePoses truncated_poses_;
    const uint32_t bands_;
    TransferTruth truth_;
    Reference pixels_, vertices_;
    RelativeNoise pixel_noise_, vertex_noise_;
};

// The difference of two pictures, relative to the truth.
ImageError step_error(const Image& after, const Image& before, const Image& truth) {
    ImageError error = compare_images(after, before);
    const ImageError of_truth = compare_images(truth, truth);
    error.reference_sum = of_truth.reference_sum;
    error.reference_peak = of_truth.reference_peak;
    return error;
}

std::vector<Image> first_view(const std::vector<Image>& pictures, size_t num_lights) {
    return {pictures.begin(), pictures.begin() + static_cast<ptrdiff_t>(num_lights)};
}

}  // namespace

double ErrorBudget::sum(size_t light) const {
    double sum = 0.0;
    for (const BudgetTerm& term : terms) sum += term.errors[light].visual_error();
    return sum;
}

size_t budget_steps(const Stage& stage) {
    return (std::size(kCauses) + kPixelStep) * stage.poses().size();
}

ErrorBudget measure_budget(const BakeReader& bake, const Asset& file, const Stage& stage,
                           uint32_t rays, const std::filesystem::path& scratch,
                           const std::function<void()>& on_step) {
    const size_t num_lights = stage.lights().size();
    ErrorBudget budget;
    budget.whole.resize(num_lights);
    for (const auto& cause : kCauses) {
        budget.terms.push_back(
            {cause.name, cause.meaning, cause.cure, std::vector<PictureErrors>(num_lights), {}});
    }
    Chain chain(bake, file, stage, rays, scratch, on_step);
    for (const uint32_t p : stage.poses()) {
        std::vector<Image> truth, before;
        auto term = budget.terms.begin();
        chain.follow(p, [&](std::vector<Image> pictures) {
            if (truth.empty()) {
                truth = before = std::move(pictures);
                if (budget.truth.empty()) budget.truth = first_view(truth, num_lights);
                return;
            }
            for (size_t j = 0; j < pictures.size(); ++j) {
                term->errors[j % num_lights].add(step_error(pictures[j], before[j], truth[j]), p,
                                                 j / num_lights);
            }
            if (term->pictures.empty()) term->pictures = first_view(pictures, num_lights);
            ++term;
            before = std::move(pictures);
        });
        for (size_t j = 0; j < before.size(); ++j) {
            budget.whole[j % num_lights].add(compare_images(before[j], truth[j]), p,
                                             j / num_lights);
        }
    }
    budget.pixel_noise = chain.pixel_noise();
    budget.vertex_noise = chain.vertex_noise();
    budget.transfer_rays = chain.transfer_rays();
    return budget;
}

}  // namespace paim
