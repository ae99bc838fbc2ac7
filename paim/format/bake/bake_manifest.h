// The manifest of a .bake directory: its identity as JSON.
#pragma once

#include <filesystem>
#include <string>

#include "paim/format/bake/bake_directory.h"

namespace paim {

// The text as a manifest gives it back: bytes that are not UTF-8 (file names may have them)
// replaced.
std::string as_manifest_text(const std::string& text);

std::string manifest_text(const BakeIdentity& identity);

// Errors (bad input, unsupported) name the file and the member.
BakeIdentity read_manifest(const std::filesystem::path& path);

// The first difference between a bake that is there and one that is asked for, in words; empty if
// none.
std::string first_difference(const BakeIdentity& there, const BakeIdentity& wanted);

// The checksum by which a pose file knows the bake it belongs to.
uint64_t identity_checksum(const BakeIdentity& identity);

}  // namespace paim
