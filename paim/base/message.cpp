// Messages with values in them, through {fmt}.
#include "paim/base/message.h"

#include <fmt/args.h>
#include <fmt/format.h>

namespace paim {

std::string format_message(std::string_view format, std::initializer_list<MessageValue> values) {
    fmt::dynamic_format_arg_store<fmt::format_context> arguments;
    arguments.reserve(values.size(), 0);
    for (const MessageValue& value : values) {
        std::visit([&](const auto& held) { arguments.push_back(held); }, value);
    }
    return fmt::vformat(format, arguments);
}

}  // namespace paim
