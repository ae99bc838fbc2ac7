// A directory for files on the way to a result.
#pragma once

#include <filesystem>
#include <string_view>

namespace paim {

// A hidden directory next to a result, of this process alone. The destructor removes it with all that
// is in it. What killed processes left is removed when the next one is made for the same result and
// purpose.
class HiddenDirectory {
  public:
    // purpose  part of the name: "pilot"
    // Errors (output failed), naming the path.
    HiddenDirectory(const std::filesystem::path& result, std::string_view purpose);
    ~HiddenDirectory();
    HiddenDirectory(const HiddenDirectory&) = delete;
    HiddenDirectory& operator=(const HiddenDirectory&) = delete;

    const std::filesystem::path& path() const { return path_; }

    // Makes it the result. Returns false, and nothing has changed, if a directory with files is
    // there.
    bool become(const std::filesystem::path& result) const;

  private:
    std::filesystem::path path_;
    int lock_ = -1;
};

}  // namespace paim
