// A strict check of an OBJ file for everything that a pose sequence needs, with line numbers in
// errors.
//
// General OBJ parsers read garbage as 0 and check little, so every file is scanned before it is
// parsed. The scan also rewrites the text in place, so that the parser sees only what was checked:
// v, vn, vt and f lines, without comments and continued lines.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/polygons.h"
#include "paim/base/vector.h"

namespace paim {

// An object or group of a file.
struct ObjName {
    std::string name;       // printable
    size_t first_face = 0;  // the faces from here to that of the next name are its own
};

constexpr uint32_t kNoCoordinate = UINT32_MAX;

struct ObjScan {
    uint32_t num_vertices = 0;
    Polygons faces;                // in the order of the file, all objects and groups together
    std::vector<Vec3d> positions;  // [V] scene units, floats in range; empty unless read_positions
    // Every vertex of a face is x y z r g b. Vertices of no face need no colour.
    bool has_colors = false;
    // [V] r g b to the nearest doubles, white where there is none; empty unless read_colors and
    // has_colors.
    std::vector<Vec3d> colors;
    // If only some vertices of faces have a colour: the number of those without, and the first.
    uint64_t num_uncolored = 0;
    uint32_t first_uncolored = 0;
    uint64_t num_small_faces = 0;   // faces of fewer than 3 corners, which are ignored
    uint64_t num_other_shapes = 0;  // points and lines, which are ignored

    // Empty unless read_materials.
    std::vector<std::string> libraries;   // what follows each mtllib
    std::vector<std::string> materials;   // the names that follow usemtl, each once
    std::vector<int32_t> face_materials;  // per face: index into materials, or -1
    // Empty unless read_coordinates, and unless a corner of a face has a texture coordinate.
    std::vector<uint32_t>
        corner_coordinates;          // per corner: index into coordinates, or kNoCoordinate
    std::vector<Vec2f> coordinates;  // u v of the vt lines; zero where one is not finite
    // For messages, without a reference only: objects, or groups before the first object.
    std::vector<ObjName> names;
};

// The first file of a sequence, with which later ones are compared.
struct ObjReference {
    std::string name;  // for messages
    const ObjScan& scan;
};

struct ObjScanOptions {
    // Whether normals will be used. Then vn must be numbers, normal indices must be in range, and
    // every vertex of a face must have a normal at one of its corners. Otherwise vn are blanked.
    bool check_normals = false;
    const ObjReference* reference = nullptr;
    bool read_positions = false;  // to the nearest double
    bool read_materials = false;
    bool read_colors = false;
    bool read_coordinates = false;  // of textures; vt lines become comments, and are not checked
};

// name  of the file, for messages
// text  the whole file; rewritten as described above, without moving bytes
// Lines end with LF, CRLF or CR; a backslash at the end of a v, vn, f line continues it.
// Errors (bad input); of several of the same kind, the first in the file is reported:
//   bytes that are not text; a coordinate that is not a finite number within float's range; a face
//   corner that is not v, v/vt, v//vn or v/vt/vn; more than 1,000,000 corners; no vertices, no
//   faces; another number of vertices than the reference; indices out of range; other faces than
//   the reference.
ObjScan scan_obj(const std::string& name, std::span<char> text, const ObjScanOptions& options = {});

// The positions of a text that scan_obj() has let pass before, without a look at its other lines.
// text  as it was before that scan; rewritten in parts
std::vector<Vec3d> scan_positions(const std::string& name, std::span<char> text);

}  // namespace paim
