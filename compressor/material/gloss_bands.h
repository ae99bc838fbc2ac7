// How many bands of light and of outgoing radiance the reflection of a BRDF needs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compressor/material/brdf.h"

namespace paim {

// The most bands that are chosen. With both, a vertex has 25 · 16 coefficients. More bands of light
// change pictures little, and each outgoing band costs much (docs/results/gloss.md): more are baked
// where they are asked for.
constexpr uint32_t kMostChosenInBands = 5;
constexpr uint32_t kMostChosenOutBands = 4;
constexpr double kDefaultGlossError = 0.05;

// The shares of the energy of reflected light that numbers of bands leave out, 0 … 1. Energy is the
// square of the radiance f(s, v) cos θ_s that leaves towards v for light from s alone, as if light of
// unit power and random sign came from each direction by itself. Light of few bands loses less.
struct GlossEnergy {
    // [b] with b bands of light: the mean over directions of view, weighted by cos θ_v.
    std::vector<double> left_out_in;
    // [b] with b bands of outgoing radiance, with the mirror image below the surface: the mean over
    // directions of light, weighted by cos θ_s.
    std::vector<double> left_out_out;
};

// Up to this many bands. err  1e-4, for exponents of Phong up to 10,000 and roughness from 0.02
GlossEnergy gloss_energy(const Brdf& brdf, uint32_t most_bands);

struct GlossBands {
    uint32_t in = 1;
    uint32_t out = 1;
    double error_in = 0.0;  // share of the energy that this many bands leave out
    double error_out = 0.0;
};

// The fewest bands that each leave out at most this share of the energy, or as many as there may be.
// energy  of at least as many bands (checked)
GlossBands choose_gloss_bands(const GlossEnergy& energy, double max_error = kDefaultGlossError,
                              uint32_t most_in = kMostChosenInBands,
                              uint32_t most_out = kMostChosenOutBands);

// What so many bands leave out.
// energy   of at least as many bands (checked)
// in, out  at least 1
GlossBands given_gloss_bands(const GlossEnergy& energy, uint32_t in, uint32_t out);

// For users: what the bands leave out of the reflection, if it is more than this share of its energy;
// otherwise empty.
// brdf  in words
std::string gloss_bands_note(const std::string& brdf, const GlossBands& bands,
                             double max_error = kDefaultGlossError);

}  // namespace paim
