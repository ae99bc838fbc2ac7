// The still meshes of a bake, as one part of an asset.
#pragma once

#include <optional>

#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Floats, with the first bands of the transfer; nothing if the bake has no still meshes.
// bands  1 … the bake's
std::optional<CodedMesh> still_part(const BakeReader& bake, uint32_t bands);

}  // namespace paim
