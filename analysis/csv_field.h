// A field of a CSV file.
#pragma once

#include <string>

namespace paim {

// In quotes if it needs them.
// Based on: Shafranovich, RFC 4180, Common Format and MIME Type for Comma-Separated Values (CSV)
//           Files, 2005
std::string csv_field(const std::string& text);

}  // namespace paim
