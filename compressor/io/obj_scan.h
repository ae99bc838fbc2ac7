// A strict check of an OBJ file: what a pose sequence needs of it, with line numbers in errors.
//
// General OBJ parsers read garbage as 0 and check little, so every file is scanned before it is
// parsed. The scan also rewrites the text in place, so that the parser gets nothing else than what
// was checked: only v, vn, vt, f, usemtl and mtllib lines stay, comments and continuations are
// gone.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/polygons.h"
#include "paim/base/vector.h"

namespace paim {

struct ObjScan {
    uint32_t num_vertices = 0;
    Polygons faces;                 // in the order of the file, all objects and groups together
    std::vector<Vec3d> positions;   // [V] scene units, within float's range; if asked for
    bool has_colors = false;        // every vertex is x y z r g b
    uint64_t num_small_faces = 0;   // faces of fewer than 3 corners, which are left out
    uint64_t num_other_shapes = 0;  // points and lines, which are left out
};

// What later files of a sequence are compared with: the first one.
struct ObjReference {
    std::string name;  // for messages
    const ObjScan& scan;
};

struct ObjScanOptions {
    // Normals will be used: vn must be numbers, normal indices in range, and every vertex of a face
    // needs a normal at one of its corners. Otherwise vn are blanked.
    bool check_normals = false;
    const ObjReference* reference = nullptr;
    bool read_positions = false;  // to the nearest double
};

// name  of the file, for messages
// text  the whole file; rewritten as said above, no byte moves
// Lines end with LF, CRLF or CR; a backslash at the end of a v, vn, f line continues it.
// Errors (bad input), the first in the file where there are several of the same kind:
//   bytes that are no text; a coordinate that is not a finite number within float's range; a face
//   corner that is not v, v/vt, v//vn or v/vt/vn; more than 255 corners; no vertices, no faces;
//   another number of vertices than the reference; indices out of range; other faces than the
//   reference.
ObjScan scan_obj(const std::string& name, std::span<char> text, const ObjScanOptions& options = {});

}  // namespace paim
