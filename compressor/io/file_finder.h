// Finds files by the names that other machines wrote.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paim {

class FileFinder {
  public:
    // folder  that names are relative to
    explicit FileFinder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // The file of this name: as it is written, without quotes round it, with each '\' as '/', or
    // without backslashes before spaces.
    std::optional<std::filesystem::path> find(std::string_view name) const;

    struct Elsewhere {
        std::filesystem::path path;
        bool in_other_case = false;
    };
    // For a name that find() does not know: the only file whose path differs in case only (of the
    // letters A to Z); or else what follows its last '/' or '\', in the folder itself, as written
    // or in other case.
    std::optional<Elsewhere> find_elsewhere(std::string_view name);

  private:
    using Entries = std::map<std::string, std::vector<std::string>>;  // by name in lower case

    std::optional<std::filesystem::path> existing(const std::string& name) const;
    std::optional<std::filesystem::path> find_in_other_case(const std::filesystem::path& name);
    const std::string* only_entry(const std::filesystem::path& folder, const std::string& name);

    std::filesystem::path folder_;
    std::map<std::string, Entries> folders_;  // that were listed
};

// Without quotes round it.
std::string_view without_quotes(std::string_view text);

}  // namespace paim
