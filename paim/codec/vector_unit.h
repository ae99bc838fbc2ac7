// The vector units of a machine that decoding has kernels for.
#pragma once

#include <span>

namespace paim {

// `plain` is one value after the other, as sums are written down: the reference for the others.
// `portable` leaves vectors to the compiler.
enum class VectorUnit { plain, portable, avx2, avx512 };

// Those that this machine has, ascending: at least plain and portable.
std::span<const VectorUnit> vector_units();

// The last of vector_units().
VectorUnit best_vector_unit();

}  // namespace paim
