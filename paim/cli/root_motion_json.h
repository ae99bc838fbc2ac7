// What tools say of a root motion in JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "paim/mesh/root_motion.h"

namespace paim::cli {

// Adds the member `root_motion`, unless there is none.
inline void add_root_motion(nlohmann::ordered_json& json, const RootMotion& motion) {
    if (motion.empty()) return;
    const Travel travel = travel_of(motion);
    json["root_motion"] = {{"distance", travel.distance}, {"angle_deg", travel.angle_deg}};
}

}  // namespace paim::cli
