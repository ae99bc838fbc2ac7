// Which files make up a pose sequence: command-line arguments to a list of OBJ paths.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace paim {

// arguments   files, patterns with * ? [] (for shells that leave them alone, and for more files
// than
//             a command line holds), folders (every *.obj in them, not below)
// keep_order  false: the whole list in natural order (x_2 before x_10), each path once;
//             true: arguments as they come, each pattern or folder in natural order within itself,
//             a path that is named twice is two poses
// An existing file is taken whatever its name; patterns and folders give files ending in .obj only
// (in either case). A plain name that does not exist is passed on: opening it says what is wrong.
// Errors (bad input): no arguments; a pattern or folder without an OBJ file; an unreadable folder.
std::vector<std::filesystem::path> find_obj_files(const std::vector<std::string>& arguments,
                                                  bool keep_order);

}  // namespace paim
