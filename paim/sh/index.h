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

}  // namespace paim::sh
