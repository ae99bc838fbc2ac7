// The one place where a tool's exceptions become a message and an exit code.
#pragma once

#include <functional>
#include <string_view>

namespace paim::cli {

// Runs the body, its loops on all cores, and returns its exit code. An Error prints "TOOL: message"
// on stderr and returns its code; out-of-memory and anything unforeseen do so too (codes 4 and 2),
// never a crash.
int run_main(std::string_view tool, const std::function<int()>& body);

}  // namespace paim::cli
