// How far a search is, for those who wait.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

namespace paim {

// How long a search takes is not known beforehand. Its stages are given shares of the whole, which
// are about right for usual animations. In a stage each piece of work takes a share of what is left
// of it, so that the number only grows.
class SearchProgress {
  public:
    // step  what is being done
    // done  of the whole, 0 … 1
    using Listener = std::function<void(const std::string& step, double done)>;

    explicit SearchProgress(Listener listener = {}) : listener_(std::move(listener)) {}

    // A stage that usually ends when `until` of the whole is done; if more is done already, one that
    // takes half of what is left.
    void begin(std::string step, double until) {
        step_ = std::move(step);
        until_ = until > done_ ? until : 0.5 * (done_ + 1.0);
        advance(0.0);
    }
    // share  of what is left of the stage
    void advance(double share) {
        done_ += share * (until_ - done_);
        if (listener_) listener_(step_, done_);
    }

  private:
    Listener listener_;
    std::string step_;
    double done_ = 0.0, until_ = 0.0;
};

}  // namespace paim
