// Finds the OBJ files of a pose sequence from command-line arguments.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace paim {

// arguments   files, patterns with * ? [] (which shells may not expand, or not into so many files),
//             folders (every *.obj directly in them)
// keep_order  false: the whole list in natural order (natural_order.h), each path once;
//             true: in the order of the arguments, each pattern or folder in natural order within
//             itself; a path that is named twice is two poses
// notes       gets a line for every gap and every frame number that is there twice in what was
//             sorted (frame_notes.h); null if none are wanted
// A named file may have any name; patterns and folders give only files that end in .obj (in either
// case), and none that begin with a point unless the pattern does. A name without pattern that does
// not exist is returned, too; opening it gives the error.
// Errors (bad input): no arguments; a pattern or folder without an OBJ file; an unreadable folder.
std::vector<std::filesystem::path> find_obj_files(const std::vector<std::string>& arguments,
                                                  bool keep_order,
                                                  std::vector<std::string>* notes = nullptr);

}  // namespace paim
