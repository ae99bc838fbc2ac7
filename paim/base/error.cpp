// Foreseeable failures become exceptions.
#include "paim/base/error.h"

namespace paim {

void throw_error(ExitCode code, std::string_view format,
                 std::initializer_list<MessageValue> values) {
    throw Error(code, format_message(format, values));
}

}  // namespace paim
