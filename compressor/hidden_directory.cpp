// A directory for files on the way to a result.
#include "compressor/hidden_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <system_error>

#include "paim/base/file.h"

namespace paim {

namespace fs = std::filesystem;

namespace {

// A descriptor that holds the lock of a directory, or -1 if another process has it.
int lock_directory(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
    if (descriptor >= 0) ::close(descriptor);
    return -1;
}

void remove_abandoned(const fs::path& parent, const std::string& prefix) {
    std::error_code failure;
    for (fs::directory_iterator entry(parent, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(prefix) || name.size() == prefix.size()) continue;
        const std::string_view number = std::string_view(name).substr(prefix.size());
        if (number.find_first_not_of("0123456789") != std::string_view::npos) continue;
        const int lock = lock_directory(entry->path());
        if (lock < 0) continue;
        fs::remove_all(entry->path(), failure);
        failure.clear();
        ::close(lock);
    }
}

}  // namespace

HiddenDirectory::HiddenDirectory(const fs::path& result, std::string_view purpose) {
    const fs::path target = follow_links(fs::absolute(result));
    const fs::path parent = target.parent_path();
    const std::string prefix = fmt::format(".{}.{}-", target.stem().string(), purpose);
    ensure_directory(parent);
    remove_abandoned(parent, prefix);
    path_ = parent / fmt::format("{}{}", prefix, ::getpid());
    ensure_directory(path_);
    lock_ = lock_directory(path_);
}

HiddenDirectory::~HiddenDirectory() {
    std::error_code ignored;  // the next one for this result removes it
    fs::remove_all(path_, ignored);
    if (lock_ >= 0) ::close(lock_);
}

bool HiddenDirectory::become(const fs::path& result) const {
    std::error_code failure;
    fs::rename(path_, follow_links(result), failure);
    return !failure;
}

}  // namespace paim
