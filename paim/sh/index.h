// How spherical-harmonic coefficients are numbered (docs/conventions.md): i = l(l+1)+m, B bands
// have B² coefficients, l = 0 … B−1.
#pragma once

namespace paim::sh {

// The largest number of bands that any function takes. Tests of the basis go up to it.
constexpr int kMaxBands = 64;

constexpr int num_coefficients(int bands) {
    return bands * bands;
}

constexpr int index(int l, int m) {
    return l * (l + 1) + m;
}

// The band l of coefficient i.
constexpr int band_of(int i) {
    int l = 0;
    while ((l + 1) * (l + 1) <= i) ++l;
    return l;
}

// Functions that are even in z, f(x, y, z) = f(x, y, −z), have only coefficients with even l + m:
// l + 1 of band l, m = −l, −l + 2 … l. They are numbered in this order, band after band.
constexpr int num_even_coefficients(int bands) {
    return bands * (bands + 1) / 2;
}

// The band l of even coefficient k.
constexpr int band_of_even(int k) {
    int l = 0;
    while (num_even_coefficients(l + 1) <= k) ++l;
    return l;
}

// The number among all coefficients of even coefficient k.
constexpr int even_coefficient(int k) {
    const int l = band_of_even(k);
    return index(l, 2 * (k - num_even_coefficients(l)) - l);
}

}  // namespace paim::sh
