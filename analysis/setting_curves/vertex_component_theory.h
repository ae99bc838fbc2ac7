// What dropping the last components of every vertex should cost, by the values of a file alone.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry, 2012,
//           whose measure is taken over all groups of vertices
#pragma once

#include <vector>

#include "paim/codec/transfer_model.h"

namespace paim {

// Component j of a group of vertices adds a matrix of rank one to its transfer in each plane and pose. The
// norm of all of it over vertices, planes and poses takes the part of a singular value.
struct VertexComponentSpectrum {
    std::vector<double> sum;   // [components] Σ of the norms over groups
    std::vector<double> root;  // [components] √ Σ of their squares over groups
};

// Empty if the codec has no components of vertices, or none that are points of groups (point_groups()).
VertexComponentSpectrum vertex_component_spectrum(const TransferModel& transfer);

}  // namespace paim
