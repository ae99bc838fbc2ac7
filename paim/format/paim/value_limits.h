// What the numbers of a .paim must keep to so that every pose decodes to finite values.
#pragma once

#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/container_reader.h"

namespace paim {

// All errors are bad input and name the file.

// Reads steps of integers. Each is at least 0, and 2¹⁵ times it is finite (checked).
std::vector<float> read_steps(const ContainerReader& reader, const Section& section);

// Singular values are finite and descend from at least 0, one or more for every component.
void check_singular_values(const ContainerReader& reader, const LowRank& matrix);

// Positions that are to be smoothed are integers that leave room for so many fraction bits.
void check_smoothing(const ContainerReader& reader, const LowRank& positions);

// Positions and transfer cannot overflow in any pose with any number of components.
void check_magnitudes(const ContainerReader& reader, const CodedMesh& mesh);

}  // namespace paim
