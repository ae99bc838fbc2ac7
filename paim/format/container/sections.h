// Names of the sections of .paim and .bake files.
#pragma once

#include "paim/format/container/container.h"

namespace paim::section {

constexpr Tag kKindAnimation("ANIM");
constexpr Tag kKindMesh("MESH");
constexpr Tag kKindPose("POSE");

constexpr Tag kMetadata("META");   // u8 [n]: JSON text
constexpr Tag kTriangles("TRIS");  // u32 [F][3]
constexpr Tag kAlbedo("ALBD");     // f32 [1 or V][3]

// .paim: mean, components, weights and spectrum of geometry, transfer and gloss.
constexpr Tag kMean[3] = {Tag("GMEA"), Tag("TMEA"), Tag("XMEA")};  // f32, i16 or i8 [planes][N]
constexpr Tag kComponent[3] = {Tag("GCMP"), Tag("TCMP"),
                               Tag("XCMP")};  // f32, f16, i16 or i8 [planes][N], index k
constexpr Tag kWeights[3] = {Tag("GWGT"), Tag("TWGT"), Tag("XWGT")};         // f32 or i16 [K][P]
constexpr Tag kSingularValues[3] = {Tag("GSPC"), Tag("TSPC"), Tag("XSPC")};  // f64 or f32 [n]
// Only if values (weights) are integers.
constexpr Tag kSteps[3] = {Tag("GSTP"), Tag("TSTP"), Tag("XSTP")};        // f32 [planes]
constexpr Tag kWeightSteps[3] = {Tag("GWST"), Tag("TWST"), Tag("XWST")};  // f32 [K]
// Only if some vertices are glossy. Sections of the codec of gloss have the tags of those of the
// transfer, with X as their first letter.
constexpr Tag kGlossTint("XTNT");      // f32 [1 or R][3]
constexpr Tag kGlossVertices("XVTX");  // u32 [R][1], only if not all vertices are rows
// Only if frames of gloss are turned (CodedGloss::frame_turns): i16 [3][R], f32 [3].
constexpr Tag kFrameTurns("XFRT");
constexpr Tag kFrameTurnSteps("XFRS");
// Only if geometry is smoothed: i16 [1 + K][3], rounds of the mean and each component.
constexpr Tag kSmoothing("GSMO");

// Only if the moving part has a root motion: f64 [P][6], rotation vector, translation.
constexpr Tag kRootMotion("ROOT");

// .paim: the still part; all four or none.
constexpr Tag kStillTriangles("STRI");  // u32 [F][3]
constexpr Tag kStillPositions("SPOS");  // f32, i16 or i8 [3][S]
constexpr Tag kStillAlbedo("SALB");     // f32 [1 or S][3]
constexpr Tag kStillTransfer("STRN");   // f32, i16 or i8 [planes][S]
// Only if values are integers: f32 [planes].
constexpr Tag kStillPositionSteps("SPST");
constexpr Tag kStillTransferSteps("STST");
// Only if the still part has gloss; as those of the moving part.
constexpr Tag kStillGloss("SGLS");           // f32, i16 or i8 [planes of gloss][R]
constexpr Tag kStillGlossSteps("SGST");      // f32 [planes of gloss]
constexpr Tag kStillGlossTint("SGTN");       // f32 [1 or R][3]
constexpr Tag kStillGlossVertices("SGVX");   // u32 [R][1]
constexpr Tag kStillFrameTurns("SGFT");      // i16 [3][R]
constexpr Tag kStillFrameTurnSteps("SGFS");  // f32 [3]

// Only if faces have images: the texture of a mesh (texture_sections.h). In a .paim the second is of
// the still part.
struct TextureTags {
    Tag names;        // u8 [n]: the name of each image, and a zero byte after each
    Tag image;        // u8 [n], index i: a PNG or JPEG file
    Tag coordinates;  // f32 [T][2]
    Tag corners;      // u32 [F][3]
    Tag of_face;      // u32 [F]: 0: none; i + 1: image i
    Tag factors;      // f32 [images][3]
};
constexpr TextureTags kTexture[2] = {
    {Tag("TXNM"), Tag("TXIM"), Tag("TXUV"), Tag("TXCO"), Tag("TXFI"), Tag("TXFC")},
    {Tag("SXNM"), Tag("SXIM"), Tag("SXUV"), Tag("SXCO"), Tag("SXFI"), Tag("SXFC")}};

// .bake poses and still meshes.
constexpr Tag kPositions("POSN");  // f32 [3][V]
constexpr Tag kNormals("NRML");    // f32 [3][V]
constexpr Tag kTransfer("TRNF");   // f32 [planes][V]
constexpr Tag kNoise("NOIS");      // f16 [planes][V]
// Only of glossy vertices; rows as in mesh/materials.h.
constexpr Tag kGloss("GLSS");       // f32 [planes of gloss][R]
constexpr Tag kGlossNoise("GLNS");  // f16 [planes of gloss][R]
// Only of bakes with gloss: u32 [1 or V][1], Materials::of_vertex.
constexpr Tag kMaterials("MATL");

}  // namespace paim::section
