// What the numbers of a .paim must keep to so that every pose decodes to finite values.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/container/container_reader.h"

namespace paim {

// All errors are bad input. Those of readers name the file.

// Reads steps of integers. Each is at least 0, and 2¹⁵ times it is finite (checked).
std::vector<float> read_steps(const ContainerReader& reader, const Section& section);

// Singular values are finite and descend from at least 0, one or more for every component.
void check_singular_values(const ContainerReader& reader, const LowRank& matrix);

// Positions that are to be smoothed are integers that leave room for so many fraction bits.
void check_smoothing(const ContainerReader& reader, const LowRank& positions);

// Positions and transfer cannot overflow in any pose with any number of components. Readers refuse
// files in which they could, and writers do not write them.
class MagnitudeLimits {
  public:
    // mesh  without the values of means and components
    explicit MagnitudeLimits(const CodedMesh& mesh);

    // bounds  of the planes of this attribute (codec/magnitude_bounds.h)
    // where   how messages begin
    // advice  how they end
    void check(Attribute attribute, std::span<const double> bounds, std::string_view where,
               std::string_view advice = {}) const;

  private:
    // What is decoded gets larger by a factor, and by what is added.
    struct Growth {
        double factor, added;
    };
    std::array<Growth, kNumAttributes> growth_;  // of each attribute
};

// The same of a mesh with all values.
void check_magnitudes(const CodedMesh& mesh, std::string_view where, std::string_view advice = {});

// What users can do about numbers that are too large to be written.
inline constexpr std::string_view kScaleDown = ": scale the poses down";

}  // namespace paim
