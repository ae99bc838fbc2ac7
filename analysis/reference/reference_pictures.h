// Pictures that errors are measured against.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "analysis/stage.h"

namespace paim {

// Pictures with what is known about their noise.
struct ReferencePictures {
    std::vector<Image> pictures;  // [Stage::num_pictures()]
    // [pictures] one draw with the variance of their errors; empty: the reference has none
    std::vector<Image> noise;
};

// Pictures of pose p, which the bake has like this.
using ReferenceSource = std::function<ReferencePictures(uint32_t p, const DecodedPose& baked)>;

// Σ |noise| / Σ |picture| over all pictures of each light, as visual errors are measured.
class RelativeNoise {
  public:
    explicit RelativeNoise(size_t num_lights) : noise_(num_lights), all_(num_lights) {}

    void add(const ReferencePictures& reference);

    // 0 without noise, not a number where all pictures are black. [lights]
    std::vector<double> relative() const;

  private:
    std::vector<double> noise_, all_;  // [lights]
};

}  // namespace paim
