// Small animations made by code, whose decoding and shading on the CPU is known.
#pragma once

#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/light/environment.h"
#include "player/render/frame.h"

namespace paim::player {

struct TestAssetOptions {
    uint32_t bands = 5;
    uint32_t channels = 1;
    uint32_t num_poses = 6;
    uint32_t geometry_components = 3;
    uint32_t transfer_components = 5;
    Precision precision = Precision::f32;  // of both matrices and their means
    // Of component k, or, if shorter, the last; empty: all as `precision`.
    std::vector<Precision> component_precisions;
    bool albedo_per_vertex = false;
    uint32_t num_rings = 8;  // of the sphere, with twice as many segments
    // Codec cpca, each vertex in any cluster; 0: codec svd.
    uint32_t num_clusters = 0;
    uint32_t cluster_components = 0;
    std::vector<Precision> coefficient_precisions;  // as component_precisions
};

// A unit sphere that bends and shimmers: smooth random components, so that neighbouring vertices
// differ little and pixels at triangle edges do not decide a comparison.
Asset make_test_asset(const TestAssetOptions& options);

// A still part, the mean pose of a mesh of codec svd: in floats, moved along x by an offset in
// scene units.
CodedMesh stand_still(const CodedMesh& mesh, float offset);

// Multiplies all positions, also those of the still part, by 2^exponent.
void scale_asset(Asset& asset, int exponent);

// Random coefficients whose constant part outweighs the rest, so that radiance is mostly positive.
LightCoefficients make_test_light(int bands);

// Light and background of the frame: the environment, turned about +Y.
void light_frame(Frame& frame, const EnvironmentLight& environment, int bands, double angle_rad);

// Radiance of every vertex at `time` as the CPU decoder and shade() give it.
std::vector<Vec3f> vertex_radiance(const CodedMesh& mesh, double time, const DecodeLimits& limits,
                                   const LightCoefficients& light);

}  // namespace paim::player
