// Errors of pictures under one light.
#include "analysis/picture_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/median.h"

namespace paim {

void PictureErrors::add(const ImageError& error, uint32_t pose, size_t view) {
    all_.add(error);
    if (!std::isnan(error.visual_error())) each_.push_back({error.visual_error(), pose, view});
}

PictureErrors::Spread PictureErrors::spread() const {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    Spread spread{kNone, kNone, kNone, kNone};
    if (each_.empty()) return spread;
    std::vector<double> errors;
    double sum = 0.0;
    for (const One& one : each_) {
        errors.push_back(one.visual_error);
        sum += one.visual_error;
    }
    const double mean = sum / static_cast<double>(errors.size());
    double squares = 0.0;
    for (const double error : errors) squares += (error - mean) * (error - mean);
    spread.deviation =
        errors.size() < 2 ? 0.0 : std::sqrt(squares / static_cast<double>(errors.size() - 1));
    // Of equal ones the first.
    const auto worst = std::max_element(each_.begin(), each_.end(), [](const One& a, const One& b) {
        return a.visual_error < b.visual_error;
    });
    spread.least = *std::min_element(errors.begin(), errors.end());
    spread.most = worst->visual_error;
    spread.worst_pose = worst->pose;
    spread.worst_view = worst->view;
    spread.median = median(std::move(errors));
    return spread;
}

}  // namespace paim
