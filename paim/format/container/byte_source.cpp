// Bytes of files and of memory. Files are read by POSIX calls, so that errors keep their reason.
#include "paim/format/container/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "paim/base/error.h"

namespace paim {

ByteSource::~ByteSource() = default;

FileSource::FileSource(const std::filesystem::path& path)
    // Non-blocking, so that a pipe is refused below instead of waited for. Regular files ignore it.
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
    if (descriptor_ < 0)
        throw_bad_input("{}: cannot open: {}", path.string(), std::strerror(errno));
    struct stat info {};
    if (::fstat(descriptor_, &info) != 0 || !S_ISREG(info.st_mode)) {
        ::close(descriptor_);
        throw_bad_input("{}: expected a regular file", path.string());
    }
}

FileSource::~FileSource() {
    ::close(descriptor_);
}

void FileSource::fail() const {
    throw_bad_input("{}: cannot read: {}", path_.string(), std::strerror(errno));
}

uint64_t FileSource::size_bytes() const {
    struct stat info {};
    if (::fstat(descriptor_, &info) != 0) fail();
    return static_cast<uint64_t>(info.st_size);
}

size_t FileSource::read(uint64_t offset, std::span<uint8_t> out) const {
    size_t done = 0;
    while (done < out.size()) {
        const ssize_t got = ::pread(descriptor_, out.data() + done, out.size() - done,
                                    static_cast<off_t>(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail();
        if (got == 0) break;
        done += static_cast<size_t>(got);
    }
    return done;
}

size_t MemorySource::read(uint64_t offset, std::span<uint8_t> out) const {
    if (offset >= bytes_.size()) return 0;
    const auto first = static_cast<size_t>(offset);
    const size_t count = std::min(out.size(), bytes_.size() - first);
    std::copy_n(bytes_.begin() + static_cast<ptrdiff_t>(first), count, out.begin());
    return count;
}

uint64_t FirstBytes::size_bytes() const {
    return std::min(source_->size_bytes(), most_bytes_);
}

size_t FirstBytes::read(uint64_t offset, std::span<uint8_t> out) const {
    if (offset >= most_bytes_) return 0;
    return source_->read(offset, out.first(std::min<uint64_t>(out.size(), most_bytes_ - offset)));
}

}  // namespace paim
