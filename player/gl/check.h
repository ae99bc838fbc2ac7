// OpenGL's own complaints as errors.
#pragma once

#include <functional>
#include <string_view>

namespace paim::player::gl {

// Throws Error(unsupported) if OpenGL has recorded an error since the last call: out of memory, or
// (a mistake of ours) a call it refused, with what `doing` names, e.g. "uploading the model".
void check_errors(std::string_view doing);

// Prints a message on stderr.
void print_driver_message(std::string_view message);

// From now on hands the driver's error messages on, where the
// context has KHR_debug. What a debug build or a test wants; otherwise costs nothing.
void report_driver_messages(
    std::function<void(std::string_view message)> report = print_driver_message);

// The largest width and height of a texture, and of what can be drawn into.
int max_texture_size();
int max_target_size();

}  // namespace paim::player::gl
