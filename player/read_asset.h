// Reads an animation in the player's unit of length.
#pragma once

#include <filesystem>
#include <memory>

#include "paim/codec/asset.h"
#include "paim/format/paim/paim_read.h"
#include "player/view/scene_units.h"

namespace paim::player {

// read_paim(), then scale_to_unit(). Errors as read_paim()'s.
// units  if not null: where the scene's places are in the asset
std::shared_ptr<const Asset> read_asset(const std::filesystem::path& path,
                                        const ReadOptions& options = {},
                                        SceneUnits* units = nullptr);

// Multiplies every position of all parts by one power of two, so that the largest coordinate of the
// first part's mean pose is about 1. This is exact, and every camera is placed by the bounds of the
// asset, so that pictures stay the same; but meshes of any size can then be drawn with the single
// precision of cameras, depths and GPUs. All prefixes of a file get the same scale.
// returns  that power of two
float scale_to_unit(Asset& asset);

}  // namespace paim::player
