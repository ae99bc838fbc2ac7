// Removes a bake, and nothing else.
#include "paim/format/bake/bake_removal.h"

#include <string>
#include <system_error>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/bake/bake_manifest.h"

namespace paim {

namespace fs = std::filesystem;

namespace {

bool is_file_of_bake(const std::string& name) {
    return name == kMeshName || name == bake_still_mesh_file({}).string() ||
           (name.starts_with("pose_") && name.ends_with(".bin")) || is_temporary_name(name);
}

void remove_file(const fs::path& path) {
    std::error_code failure;
    fs::remove(path, failure);
    if (failure) throw_output_failed("{}: cannot remove: {}", path.string(), failure.message());
}

}  // namespace

void remove_bake(const fs::path& directory) {
    std::error_code failure;
    std::vector<fs::path> files;
    for (fs::directory_iterator entry(directory, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (is_file_of_bake(entry->path().filename().string())) files.push_back(entry->path());
    }
    for (const fs::path& file : files) remove_file(file);
    remove_file(directory / kManifestName);
    fs::remove(follow_links(directory), failure);
}

}  // namespace paim
