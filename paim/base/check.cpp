// A check that failed ends the program.
#include "paim/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace paim::detail {

void check_failed(const char* file, int line, const char* what,
                  std::initializer_list<MessageValue> values) {
    std::string text = message("{}:{}: check failed: {}", file, line, what);
    if (values.size() == 2) text += format_message(" (got {} and {})", values);
    std::fprintf(stderr, "%s\n", text.c_str());
    std::abort();
}

}  // namespace paim::detail
