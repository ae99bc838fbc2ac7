// How the size of a file falls with its error: about as a power of it.
#pragma once

#include <algorithm>
#include <cmath>

namespace paim {

// The power law through the last size that is known. Everything is in natural logarithms, of errors
// (x) and of bytes (y): y falls by `fall` for each 1 of x.
class SizeCurve {
  public:
    // Falls outside are not believed: they come of sizes that scatter.
    static constexpr double kLeastFall = 0.3, kMostFall = 1.5;

    // A size that is known. The fall is learnt from this one and the one before.
    void add(double x, double y) {
        constexpr double kTooNear = 1e-3;  // for what roundings leave of a difference
        if (known_ && std::abs(x - x_) > kTooNear) {
            fall_ = std::clamp((y_ - y) / (x - x_), kLeastFall, kMostFall);
        }
        move(x, y);
    }
    // The same curve through another point.
    void move(double x, double y) {
        x_ = x;
        y_ = y;
        known_ = true;
    }
    // The error whose file has this size, by the curve. Needs a size that is known.
    double error_of(double y) const { return x_ + (y_ - y) / fall_; }

  private:
    bool known_ = false;
    double x_ = 0.0, y_ = 0.0;
    double fall_ = 0.6;  // of usual animations, 0.4 … 0.8
};

}  // namespace paim
