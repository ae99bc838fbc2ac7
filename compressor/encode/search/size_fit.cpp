// The smallest error whose file is not larger than a size.
#include "compressor/encode/search/size_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "compressor/encode/search/feasibility.h"

namespace paim {

namespace {

// Everything here is in natural logarithms, of errors (x) and of bytes (y).
const double kResolution = std::log(1.02);
// Within this a coding that was chosen for one error is used for another.
const double kNear = std::log(1.06);
constexpr double kLargestError = 0.5;

// Sizes fall about as a power of the error, which is learnt from the last two that are known.
class SizeCurve {
  public:
    void add(double x, double y) {
        constexpr double kTooNear = 1e-3;  // for what roundings leave of a difference
        if (known_ && std::abs(x - x_) > kTooNear) {
            fall_ = std::clamp((y_ - y) / (x - x_), 0.3, 1.5);
        }
        move(x, y);
    }
    // The same curve through another point.
    void move(double x, double y) {
        x_ = x;
        y_ = y;
        known_ = true;
    }
    double error_of(double y) const { return x_ + (y_ - y) / fall_; }

  private:
    bool known_ = false;
    double x_ = 0.0, y_ = 0.0;
    double fall_ = 0.6;  // of usual animations, 0.4 … 0.8
};

class SizeFit {
  public:
    SizeFit(const EncodeProblem& problem, EncodedFiles& files, uint64_t most_bytes,
            const std::function<void(const char*)>& say)
        : problem_(problem),
          files_(files),
          most_bytes_(most_bytes),
          most_(log_of(most_bytes)),
          high_(std::log(kLargestError)),
          low_(std::min(high_, std::log(1.02 * std::max(1e-4, problem.least_error())))),
          say_(say) {}

    EncodedFile run() {
        // Where nothing but halving helps, the widest of intervals takes so many.
        constexpr int kMaxRounds = 12;
        // A little smaller, to fit although sizes are not quite as the curve says.
        constexpr double kMargin = 0.005;
        double x = estimate();
        for (int round = 0; round < kMaxRounds; ++round) {
            try_error(x);
            if (best_ && (high_ - low_ <= kResolution || is_close())) break;
            x = inside(curve_.error_of(most_ - kMargin));
        }
        if (!best_) try_error(high_);  // or nothing does
        return std::move(*best_);
    }

  private:
    static double log_of(uint64_t bytes) {
        return std::log(static_cast<double>(std::max<uint64_t>(1, bytes)));
    }

    void say(const char* what, double x) const {
        say_(fmt::format("{} a transfer error of {:.3g} %", what, 100.0 * std::exp(x)).c_str());
    }

    // By estimates of sizes, until the next error is near the last.
    double estimate() {
        constexpr int kMaxEstimates = 4;
        constexpr double kUsualError = 0.04;
        double x = std::clamp(std::log(kUsualError), low_, high_);
        for (int round = 0; round < kMaxEstimates; ++round) {
            say("comparing ways to code", x);
            if (choose(x)) {
                curve_.add(x, log_of(files_.overhead_bytes(std::exp(x)) + draft_->estimated_bytes));
                const double next = inside(curve_.error_of(most_));
                if (std::abs(next - x) <= kNear) return next;
                x = next;
            } else {
                miss(x);
                x = inside(0.5 * (x + high_));
            }
        }
        return x;
    }

    // The error itself; an end that was not tried; or what halves the interval.
    double inside(double x) const {
        if (x > low_ && x < high_) return x;
        if (x <= low_ && !low_tried_) return low_;
        if (x >= high_ && !best_) return high_;
        return 0.5 * (low_ + high_);
    }

    bool choose(double x) {
        draft_.reset();  // its bases first, so that there is memory for others
        draft_ = files_.draft(std::exp(x), reason_);
        chosen_at_ = draft_at_ = x;
        return draft_.has_value();
    }

    void miss(double x) {
        if (x >= high_ && !best_) throw_infeasible(reason_);
        low_ = x;
        low_tried_ = true;
    }

    // A file of this error becomes the best if it fits.
    void try_error(double x) {
        say("trying", x);
        const double error = std::exp(x);
        std::optional<EncodedFile> file;
        // Near by, the same way to code it is the best, with other steps.
        if ((draft_ && std::abs(x - chosen_at_) <= kNear) || choose(x)) {
            scale_steps(problem_, files_.targets(std::exp(draft_at_)), files_.targets(error),
                        draft_->coding);
            file = files_.meet(error, std::move(*draft_), reason_);
            draft_.reset();
        }
        if (!file) {
            miss(x);
            return;
        }
        draft_ = EncodedFiles::Draft{std::move(file->coding), file->candidates};
        draft_at_ = x;
        const uint64_t bytes = file->file.size_bytes();
        if (tried_) {
            curve_.add(x, log_of(bytes));
        } else {
            curve_.move(x, log_of(bytes));  // estimates are some percent too high
        }
        tried_ = true;
        if (bytes <= most_bytes_) {
            best_ = std::move(file);
            high_ = x;
            return;
        }
        reason_ = fmt::format(
            "{}: --max-size asks for {} bytes; with a transfer error of {:.0f} % it takes {}",
            problem_.bake.directory().string(), most_bytes_, 100.0 * kLargestError, bytes);
        miss(x);
    }

    // Whether files of errors that much smaller would not fit any more.
    bool is_close() const { return high_ - curve_.error_of(most_) <= kResolution; }

    const EncodeProblem& problem_;
    EncodedFiles& files_;
    const uint64_t most_bytes_;
    const double most_;
    double high_,
        low_;  // files of errors up to low_ do not fit, those from high_ on do, once tried
    bool low_tried_ = false;
    bool tried_ = false;  // a file, so that the curve is of sizes and not of estimates
    SizeCurve curve_;
    std::optional<EncodedFiles::Draft> draft_;
    double chosen_at_ = 0.0;  // the error that the draft's coding was chosen for
    double draft_at_ = 0.0;   // and the one of its steps
    std::optional<EncodedFile> best_;
    std::string reason_;
    const std::function<void(const char*)>& say_;
};

}  // namespace

EncodedFile fit_size(const EncodeProblem& problem, EncodedFiles& files, uint64_t most_bytes,
                    const std::function<void(const char*)>& say) {
    check_feasible(problem, kLargestError);
    return SizeFit(problem, files, most_bytes, say).run();
}

}  // namespace paim
