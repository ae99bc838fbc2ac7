// OpenGL's own complaints as errors.
#pragma once

#include <string_view>

namespace paim::player::gl {

// Throws Error(unsupported) if OpenGL has recorded an error since the last call: out of memory, or
// (a mistake of ours) a call it refused, with what `doing` names, e.g. "uploading the model".
void check_errors(std::string_view doing);

// Prints the driver's error messages on stderr, with the call's place on the stack, where the
// context has KHR_debug. What a debug build or a test wants; otherwise costs nothing.
void report_driver_messages();

// The largest width and height of a texture, and of what can be drawn into.
int max_texture_size();
int max_target_size();

}  // namespace paim::player::gl
