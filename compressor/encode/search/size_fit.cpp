// The smallest error whose file is not larger than a size.
#include "compressor/encode/search/size_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "compressor/encode/search/feasibility.h"
#include "compressor/encode/search/size_search.h"

namespace paim {

namespace {

constexpr double kLargestError = 0.5;

// The files of a problem, by error.
class FilesToFit : public SizedFiles {
  public:
    FilesToFit(const EncodeProblem& problem, EncodedFiles& files, uint64_t most_bytes)
        : problem_(problem), files_(files), most_bytes_(most_bytes) {}

    std::optional<uint64_t> estimated_bytes(double error) override {
        if (!choose(error)) return std::nullopt;
        return files_.overhead_bytes(error) + draft_->estimated_bytes;
    }

    std::optional<uint64_t> make(double error) override {
        made_.reset();
        // Near by, the same way to code it is the best, with other steps.
        const bool near = draft_ && std::abs(std::log(error / chosen_for_)) <= std::log(kNearError);
        if (!near && !choose(error)) return std::nullopt;
        scale_steps(problem_, files_.targets(steps_for_), files_.targets(error), draft_->coding);
        made_ = files_.meet(error, std::move(*draft_), reason_);
        draft_.reset();
        if (!made_) return std::nullopt;
        draft_ = EncodedFiles::Draft{std::move(made_->coding), made_->candidates};
        steps_for_ = error;
        const uint64_t bytes = made_->file.size_bytes();
        reason_ = fmt::format(
            "{}: --max-size asks for {} bytes; with a transfer error of {:.0f} % it takes {}",
            problem_.bake.directory().string(), most_bytes_, 100.0 * kLargestError, bytes);
        return bytes;
    }

    void keep() override { best_ = std::exchange(made_, std::nullopt); }

    // What was kept; needs a file that was.
    EncodedFile take_best() { return std::move(*best_); }
    // Why the error that was tried last has no file that fits.
    const std::string& reason() const { return reason_; }

  private:
    bool choose(double error) {
        draft_.reset();  // its bases first, so that there is memory for others
        draft_ = files_.draft(error, reason_);
        chosen_for_ = steps_for_ = error;
        return draft_.has_value();
    }

    const EncodeProblem& problem_;
    EncodedFiles& files_;
    const uint64_t most_bytes_;
    std::optional<EncodedFiles::Draft> draft_;
    double chosen_for_ = 1.0;  // the error that the draft's coding was chosen for
    double steps_for_ = 1.0;   // and the one of its steps
    std::optional<EncodedFile> made_, best_;
    std::string reason_;
};

}  // namespace

EncodedFile fit_size(const EncodeProblem& problem, EncodedFiles& files, uint64_t most_bytes) {
    check_feasible(problem, kLargestError);
    // At the best that the bake allows, coding itself may not add any error.
    const double least_error = 1.02 * std::max(1e-4, problem.least_error());
    FilesToFit to_fit(problem, files, most_bytes);
    if (!find_smallest_error(to_fit, least_error, kLargestError, most_bytes)) {
        throw_infeasible(to_fit.reason());
    }
    return to_fit.take_best();
}

}  // namespace paim
