// Names of the sections of .paim and .bake files.
#pragma once

#include "paim/format/container.h"

namespace paim::section {

constexpr Tag kKindAnimation("ANIM");
constexpr Tag kKindMesh("MESH");
constexpr Tag kKindPose("POSE");

constexpr Tag kMetadata("META");   // u8 [n]: JSON text
constexpr Tag kTriangles("TRIS");  // u32 [F][3]
constexpr Tag kAlbedo("ALBD");     // f32 [1 or V][3]

// .paim: mean, components, weights and spectrum of geometry and of transfer.
constexpr Tag kMean[2] = {Tag("GMEA"), Tag("TMEA")};       // f32 [planes][V]
constexpr Tag kComponent[2] = {Tag("GCMP"), Tag("TCMP")};  // f32 or f16 [planes][V], index k
constexpr Tag kWeights[2] = {Tag("GWGT"), Tag("TWGT")};    // f32 [K][P]
constexpr Tag kSpectrum[2] = {Tag("GSPC"), Tag("TSPC")};   // f64 [n]

// .paim: scenery, all four or none.
constexpr Tag kSceneryTriangles("STRI");  // u32 [F][3]
constexpr Tag kSceneryPositions("SPOS");  // f32 [3][S]
constexpr Tag kSceneryAlbedo("SALB");     // f32 [1 or S][3]
constexpr Tag kSceneryTransfer("STRN");   // f32 [planes][S]

// .bake poses and scenery.
constexpr Tag kPositions("POSN");  // f32 [3][V]
constexpr Tag kNormals("NRML");    // f32 [3][V]
constexpr Tag kTransfer("TRNF");   // f32 [planes][V]
constexpr Tag kNoise("NOIS");      // f16 [planes][V]

}  // namespace paim::section
