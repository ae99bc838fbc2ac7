// Instances in time.
#include "player/render/frame.h"

#include <cmath>

namespace paim::player {

double time_of(const Frame& frame, const Instance& instance, uint32_t num_poses) {
    if (instance.time_offset == 0.0) return frame.time;
    return std::fmod(frame.time + instance.time_offset, static_cast<double>(num_poses));
}

}  // namespace paim::player
