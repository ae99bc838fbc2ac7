// Letters of ASCII in lower case, whatever the locale.
#pragma once

namespace paim {

inline char lower_case(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
}

}  // namespace paim
