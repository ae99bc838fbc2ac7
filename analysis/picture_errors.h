// Errors of pictures under one light, over poses and views, and how they spread.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/metrics/image_error.h"

namespace paim {

class PictureErrors {
  public:
    void add(const ImageError& error, uint32_t pose, size_t view);

    // Over all pictures together.
    const ImageError& all() const { return all_; }
    double visual_error() const { return all_.visual_error(); }

    // Visual errors of single pictures. Those in which nothing is to be seen do not count; without any
    // other, nothing is a number.
    struct Spread {
        double least, median, most;
        double deviation;  // standard deviation; 0 of one picture
        uint32_t worst_pose = 0;
        size_t worst_view = 0;
    };
    Spread spread() const;

  private:
    struct One {
        double visual_error;
        uint32_t pose;
        size_t view;
    };

    ImageError all_;
    std::vector<One> each_;
};

}  // namespace paim
