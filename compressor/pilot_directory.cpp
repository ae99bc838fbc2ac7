// Where a pilot bake is while its noise is measured.
#include "compressor/pilot_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>
#include <system_error>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/bake/bake_removal.h"

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

void remove_abandoned_pilots(const fs::path& parent, const std::string& prefix) {
    std::error_code failure;
    for (fs::directory_iterator entry(parent, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (!entry->path().filename().string().starts_with(prefix)) continue;
        const int lock = lock_directory(entry->path());
        if (lock < 0) continue;
        remove_bake(entry->path());
        ::close(lock);
    }
}

}  // namespace

PilotDirectory::PilotDirectory(const fs::path& bake) {
    const fs::path target = follow_links(fs::absolute(bake));
    const fs::path parent = target.parent_path();
    const std::string prefix = fmt::format(".{}.pilot-", target.stem().string());
    ensure_directory(parent);
    remove_abandoned_pilots(parent, prefix);
    path_ = parent / fmt::format("{}{}", prefix, ::getpid());
    ensure_directory(path_);
    lock_ = lock_directory(path_);
}

PilotDirectory::~PilotDirectory() {
    try {
        remove_bake(path_);
    } catch (const Error&) {
        // The next pilot of this bake removes it.
    }
    if (lock_ >= 0) ::close(lock_);
}

bool PilotDirectory::become(const fs::path& bake) const {
    std::error_code failure;
    fs::rename(path_, follow_links(bake), failure);
    return !failure;
}

}  // namespace paim
