// Notes about frame numbers that are missing, or there twice, in the files of a sequence.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace paim {

// Appends one line for each row of frames with gaps and one for each frame number that is there
// twice: at most 8, and one more that counts the rest.
//
// A row of frames are files of one folder whose names differ in one number, the last number that
// differs among alike names. Its step is the least difference of neighbours. Gaps are told only if
// the step divides all differences and, unless it is 1, occurs twice. So frames that were
// picked by hand give no notes.
// A frame is there twice if its number is written in two ways (x_5 and x_05, .obj and .OBJ), or if
// a name continues where that of the frame ends (x_5 (1).obj).
// files  sorted; not empty
void append_frame_notes(const std::vector<std::filesystem::path>& files,
                        std::vector<std::string>& notes);

}  // namespace paim
