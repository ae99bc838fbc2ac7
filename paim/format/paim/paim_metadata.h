// The JSON metadata of a .paim.
#pragma once

#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/metadata.h"

namespace paim {

// Names of a kind of transfer: in the axes of the scene, in those of a root motion, and in those of a
// root motion that not all vertices follow. Readers that know nothing of it refuse the second and the
// third.
struct TransferNames {
    const char* in_scene;
    const char* local;
    const char* local_on_floor;
};

// Of each TransferKind. Files of glossy transfer alone are made on the way to files that have both
// kinds (ReadOptions::kind).
constexpr TransferNames kTransferNames[] = {{"diffuse", "diffuse-local", "diffuse-local-on-floor"},
                                            {"glossy", "glossy-local", "glossy-local-on-floor"}};

std::string paim_metadata(const Asset& asset);

// The index of the singular value of each of num_components components (LowRank::singular_indices).
// Empty if the metadata has none.
// Error (bad input) unless the indices ascend and are below num_singular_values.
std::vector<uint32_t> read_singular_indices(const Metadata& metadata, Attribute attribute,
                                            uint32_t num_components, size_t num_singular_values);

}  // namespace paim
