// The JSON of a .paim.
#pragma once

#include <string>

#include "paim/codec/model.h"

namespace paim {

std::string paim_metadata(const Model& model);

}  // namespace paim
