// Compares the transfer of every value of a setting with a reference.
#pragma once

#include <functional>
#include <vector>

#include "analysis/reference/reference_kind.h"
#include "analysis/setting_curves/setting_curve.h"
#include "paim/codec/mesh_decoder.h"

namespace paim {

// Where the transfer of one value of the setting comes from.
struct SettingSource {
    std::function<DecodedPose(uint32_t p)> pose;  // vertices in the order of the bake
    const DecodedPose* still = nullptr;           // the still meshes; null: as baked
};

// What a pose is compared with.
struct SettingReference {
    DecodedPose pose;  // positions that all pictures have, and transfer that errors are relative to
    ReferencePictures pictures;
};

// Poses of the bake, and pictures of the reference. Keeps references to both.
std::function<SettingReference(uint32_t p)> compared_with_bake(const BakeReader& bake,
                                                               const Reference& reference);

// Fills in what is seen, and adds the column transfer_error, over the poses of the stage. All pictures have
// the positions of the reference, so that they show what the transfer loses. One pose is in memory at a
// time.
// sources  [settings of the curve]
// on_step  called after each value of each pose
void measure_settings(SettingCurve& curve, const std::vector<SettingSource>& sources,
                      const Stage& stage,
                      const std::function<SettingReference(uint32_t p)>& reference,
                      const std::function<void()>& on_step);

}  // namespace paim
