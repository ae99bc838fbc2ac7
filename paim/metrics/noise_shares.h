// The share of noise that a decoder lets through, where it keeps some values and not others.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace paim {

// Values are put into classes by their ratio of energy to noise. What a decoder keeps of the values
// of a class is the share of the noise that it lets through there. The letters are those of
// docs/metrics.md.
class NoiseShares {
  public:
    static constexpr int kNumClasses = 40;

    // Classes are steps of √2 of the ratio, from 1/2 to 2^18.5 and beyond. Values of no energy are in
    // class 0.
    // baked, noise  sums of squares of the same values
    static uint8_t class_of(double baked, double noise) {
        const double steps = 2.0 * (std::log2(baked) - std::log2(noise)) + 2.0;
        if (!(steps > 0.0)) return 0;  // or not a number
        return static_cast<uint8_t>(std::min(steps, double{kNumClasses - 1}));
    }

    // Σ x̂ x and Σ x² of values of a class.
    void add_values(int c, double decoded_baked, double baked) {
        decoded_baked_(c) += decoded_baked;
        baked_(c) += baked;
    }
    // Σ d² of values of a class, or of their part that is projected: then it can be below 0 by chance,
    // which counts as 0.
    void add_noise(int c, double noise) { noise_(c) += noise; }
    void add(const NoiseShares& other) {
        decoded_baked_ += other.decoded_baked_;
        baked_ += other.baked_;
        noise_ += other.noise_;
    }

    // Σ over classes of Σ x̂ x / Σ x², from 0 to 1, times Σ d². NaN stays NaN.
    double passing() const {
        double sum = 0.0;
        for (int c = 0; c < kNumClasses; ++c) sum += share(c) * (noise_(c) < 0.0 ? 0.0 : noise_(c));
        return sum;
    }

  private:
    double share(int c) const {
        if (baked_(c) == 0.0) return 0.0;
        return std::clamp(decoded_baked_(c) / baked_(c), 0.0, 1.0);
    }

    using Sums = Eigen::Array<double, kNumClasses, 1>;
    Sums decoded_baked_ = Sums::Zero(), baked_ = Sums::Zero(), noise_ = Sums::Zero();
};

}  // namespace paim
