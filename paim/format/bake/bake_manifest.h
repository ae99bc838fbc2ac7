// The manifest of a .bake directory: its identity as JSON.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "paim/format/bake/bake_directory.h"

namespace paim {

inline constexpr const char* kManifestName = "manifest.json";
inline constexpr const char* kMeshName = "mesh.bin";  // triangles, albedo and texture

// The text after it was written to a manifest and read from it: bytes that are not UTF-8, which
// file names may have, are replaced.
std::string as_manifest_text(const std::string& text);

std::string manifest_text(const BakeIdentity& identity);

// Errors (bad input, unsupported) name the file and the member.
BakeIdentity parse_manifest(std::string_view text, const std::string& file);
BakeIdentity read_manifest(const std::filesystem::path& path);

// The first difference between the existing bake and the wanted one, in words; empty if there is
// none.
std::string first_difference(const BakeIdentity& there, const BakeIdentity& wanted);

// The checksum that pose files have of the identity of their bake.
uint64_t identity_checksum(const BakeIdentity& identity);

}  // namespace paim
