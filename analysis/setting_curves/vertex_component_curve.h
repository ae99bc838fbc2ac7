// Error curve over the components of a vertex of a file.
#pragma once

#include <functional>
#include <vector>

#include "analysis/reference/reference_kind.h"
#include "analysis/setting_curves/setting_curve.h"
#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// The name that the codec gives them. Error (bad input): it has none.
std::string vertex_component_name(const TransferModel& transfer);

// The file with fewer components of a vertex: what theory says of them, what they take, and how they err.
// asset   made from the bake, with components of vertices
// wanted  besides all
// on_step  called after each value of each pose
SettingCurve measure_vertex_components(const Asset& asset, const BakeReader& bake,
                                       const Stage& stage, const Reference& reference,
                                       const std::vector<uint32_t>& wanted,
                                       const std::function<void()>& on_step);

}  // namespace paim
