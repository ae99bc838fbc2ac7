// Which errors to try until the smallest one is known whose file is not larger than a size.
#include "compressor/encode/search/size_search.h"

#include <algorithm>
#include <cmath>

#include "compressor/encode/search/size_curve.h"

namespace paim {

namespace {

// Everything here is in natural logarithms, of errors (x) and of bytes (y).
const double kResolution = std::log(kErrorResolution);
const double kNear = std::log(kNearError);

class SizeSearch {
  public:
    SizeSearch(SizedFiles& files, double least_error, double largest_error, uint64_t most_bytes)
        : files_(files),
          most_bytes_(most_bytes),
          most_(log_of(most_bytes)),
          high_(std::log(largest_error)),
          low_(std::min(high_, std::log(least_error))) {}

    bool run() {
        // Where nothing but halving helps, the widest of intervals takes so many.
        constexpr int kMaxRounds = 12;
        // A little smaller, to fit although sizes are not quite as the curve says.
        constexpr double kMargin = 0.005;
        double x = estimate();
        for (int round = 0; round < kMaxRounds && !hopeless_; ++round) {
            try_error(x);
            if (hopeless_ || (kept_ && (high_ - low_ <= kResolution || is_close()))) break;
            x = inside(curve_.error_of(most_ - kMargin));
        }
        if (!kept_ && !hopeless_) try_error(high_);  // or nothing does
        return kept_;
    }

  private:
    static double log_of(uint64_t bytes) {
        return std::log(static_cast<double>(std::max<uint64_t>(1, bytes)));
    }

    // By estimates of sizes, until the next error is near the last.
    double estimate() {
        constexpr int kMaxEstimates = 4;
        constexpr double kUsualError = 0.04;
        double x = std::clamp(std::log(kUsualError), low_, high_);
        for (int round = 0; round < kMaxEstimates && !hopeless_; ++round) {
            if (const auto bytes = files_.estimated_bytes(std::exp(x))) {
                curve_.add(x, log_of(*bytes));
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
        if (x >= high_ && !kept_) return high_;
        return 0.5 * (low_ + high_);
    }

    void miss(double x) {
        if (x >= high_ && !kept_) hopeless_ = true;
        low_ = x;
        low_tried_ = true;
    }

    // A file of this error becomes the best if it fits.
    void try_error(double x) {
        const std::optional<uint64_t> bytes = files_.make(std::exp(x));
        if (!bytes) {
            miss(x);
            return;
        }
        if (tried_) {
            curve_.add(x, log_of(*bytes));
        } else {
            curve_.move(x, log_of(*bytes));  // estimates are some percent too high
        }
        tried_ = true;
        if (*bytes > most_bytes_) {
            miss(x);
            return;
        }
        files_.keep();
        kept_ = true;
        high_ = x;
    }

    // Whether files of errors that much smaller would not fit any more.
    bool is_close() const { return high_ - curve_.error_of(most_) <= kResolution; }

    SizedFiles& files_;
    const uint64_t most_bytes_;
    const double most_;
    // Files of errors up to low_ do not fit, those from high_ on do, once tried.
    double high_, low_;
    bool low_tried_ = false;
    bool tried_ = false;  // a file, so that the curve is of sizes and not of estimates
    bool kept_ = false;
    bool hopeless_ = false;  // not even the file of the largest error fits
    SizeCurve curve_;
};

}  // namespace

bool find_smallest_error(SizedFiles& files, double least_error, double largest_error,
                         uint64_t most_bytes) {
    return SizeSearch(files, least_error, largest_error, most_bytes).run();
}

}  // namespace paim
