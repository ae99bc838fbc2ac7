// Light that bounces before it reaches a vertex (E2).
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002, section 5; Goral, Torrance,
//           Greenberg and Battaile, Modeling the Interaction of Light between Diffuse Surfaces,
//           1984
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "compressor/bake/transport_row.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// The contribution of light that bounced b times to the transfer of each half, [2][channels][V][C].
using BounceTerm = std::array<std::vector<float>, 2>;

// The terms of b = 0 (no bounce), 1, 2 …
using BounceTerms = std::vector<BounceTerm>;

// The vertices that light bounces between: those of a mesh and, after them, those of a still mesh,
// whose light is known.
struct BounceScene {
    TransferLayout layout;
    size_t num_vertices = 0;
    Albedo albedo;  // [1] or [V]
    size_t num_still_vertices = 0;
    Albedo still_albedo;  // [1] or [S]
    const BounceTerms* still_terms =
        nullptr;  // at least as many terms as bounces; nullptr: no still mesh
    // Makes the row of one half of a vertex. Indices from V on are of the still mesh. Called from
    // several threads, possibly more than once for a row, and always with the same answer.
    std::function<void(size_t v, size_t half, TransportRow& row)> make_row;
};

// Adds num_bounces bounces. Each half bounces its own light with its own rays, so that half their
// difference still estimates the error of their mean. Rows beyond max_row_bytes are made again for
// each bounce, which takes longer and has the same result. Deterministic on any number of
// threads.
// halves   in: [C][V] the transfer without bounces; out: [channels · C][V] with them
// returns  terms 0 … num_bounces − 1 if keep_terms, else nothing
BounceTerms add_bounces(const BounceScene& scene, uint32_t num_bounces,
                        std::array<std::vector<float>, 2>& halves, bool keep_terms,
                        uint64_t max_row_bytes = uint64_t{1} << 30);

// Whether any colour is not grey.
bool is_coloured(const Albedo& albedo);

}  // namespace paim
