// The vector units of a machine that decoding has kernels for.
#pragma once

#include <span>

namespace paim {

// `plain` computes one value after another, as the formulas say; it is the reference for the
// others. `portable` leaves vectorisation to the compiler.
enum class VectorUnit { plain, portable, avx2, avx512 };

// The units of this machine, ascending: at least plain and portable.
std::span<const VectorUnit> vector_units();

// The last of vector_units().
VectorUnit best_vector_unit();

}  // namespace paim
