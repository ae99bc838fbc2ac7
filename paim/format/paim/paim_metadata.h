// The JSON of a .paim.
#pragma once

#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/metadata.h"

namespace paim {

std::string paim_metadata(const Asset& asset);

// Which singular value each of num_components has (LowRank::singular_indices): none if the
// metadata says nothing of them.
// Error (bad input) unless they ascend below num_singular_values.
std::vector<uint32_t> read_singular_indices(const Metadata& metadata, Attribute attribute,
                                            uint32_t num_components, size_t num_singular_values);

}  // namespace paim
