// Views as JSON files.
#pragma once

#include <filesystem>

#include "player/view/scene_units.h"
#include "player/view/view_state.h"

namespace paim::player {

// Writes every field of view_fields.h; places and distances in scene units. Errors: those of writing
// files (exit code 4).
void write_view(const std::filesystem::path& path, const ViewState& view, const SceneUnits& units);

// Sets what the file has, and leaves the rest of the view as it is. Limits of detail may be above those of
// the model. Errors (bad input) name the file and the field: not JSON, an unknown field, a value of
// another kind or out of range; files of more than 1 MB.
void read_view(const std::filesystem::path& path, const SceneUnits& units, ViewState& view);

}  // namespace paim::player
