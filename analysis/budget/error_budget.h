// Where the difference between a .paim and the traced truth comes from.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/picture_errors.h"
#include "analysis/reference/reference_kind.h"
#include "analysis/stage.h"
#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// One cause of error, switched on alone: what it changes in pictures, relative to the truth.
struct BudgetTerm {
    const char* name;
    const char* meaning;
    const char* cure;                   // what makes it smaller
    std::vector<PictureErrors> errors;  // [lights]
    std::vector<Image> pictures;  // [lights] with this cause and all before it: first pose and view
};

// The causes are a chain of pictures, from the truth to the file. Each term is the difference of two
// neighbours. So the differences add up to the whole one pixel by pixel, and the whole error is at most
// the sum of the terms.
struct ErrorBudget {
    std::vector<BudgetTerm> terms;
    std::vector<PictureErrors> whole;  // [lights] the file against the truth
    std::vector<Image> truth;          // [lights] of the first pose in the first view
    // [lights] noise of the truth at pixels, and of the truth at vertices, relative
    std::vector<double> pixel_noise, vertex_noise;
    uint32_t transfer_rays = 0;  // of the transfer without noise

    // Σ of the visual errors of all terms under a light.
    double sum(size_t light) const;
};

// file       made from this bake
// scratch    a directory for a temporary file
// rays       of traced references; 0: as many as are needed
// on_step    called after each step of each pose, budget_steps() times
// Errors: those of encode() and match_part().
ErrorBudget measure_budget(const BakeReader& bake, const Asset& file, const Stage& stage,
                           uint32_t rays, const std::filesystem::path& scratch,
                           const std::function<void()>& on_step);
size_t budget_steps(const Stage& stage);

}  // namespace paim
