// Light that bounces where some vertices are glossy, so that what they send out has directions.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002, sections 5 and 6
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/pose_rays.h"
#include "compressor/bake/sent_light.h"

namespace paim {

struct GlossyBounceScene {
    const PoseRays& rays;
    TransferLayout layout;        // of the diffuse transfer
    TransferLayout gloss_layout;  // of the same channels
    ReflectingMesh own;
    ReflectingMesh still_mesh;  // num_vertices 0: none
    // At least as many terms as bounces, if there is a still mesh.
    const std::vector<GlossyTerm>* still_terms = nullptr;
    // Of both meshes, the own first.
    const Topology& topology;
    std::span<const Vec3f> positions;
};

// Adds num_bounces bounces to the transfer of both halves, each with its own rays, which are traced
// again for every bounce. A bounce adds what the hits of the rays send out towards the vertex: to the
// diffuse transfer as a mean over the rays, and to the glossy one by the exit functions of its
// material. Bands of light that only one of the two transfers has come from that one alone.
// Deterministic on any number of threads.
// halves   in: [C][V] without bounces; out: [channels · C][V]
// gloss    in: [O · C'][R]; out: [channels · O · C'][R]
// returns  terms 0 … num_bounces − 1 if keep_terms, else nothing
// num_back_hits  rays that hit a triangle from behind are added, once each
std::vector<GlossyTerm> add_glossy_bounces(const GlossyBounceScene& scene, uint32_t num_bounces,
                                           std::array<std::vector<float>, 2>& halves,
                                           std::array<std::vector<float>, 2>& gloss,
                                           bool keep_terms, uint64_t& num_back_hits);

}  // namespace paim
