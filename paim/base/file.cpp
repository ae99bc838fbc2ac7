// Bounded reads and atomic writes, on POSIX calls so that failures keep their reason.
#include "paim/base/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include "paim/base/error.h"

namespace paim {

namespace {

// Closes a descriptor when it goes out of scope.
struct Descriptor {
    int fd;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

}  // namespace

std::vector<char> read_file(const std::filesystem::path& path, uint64_t max_size_bytes) {
    // Non-blocking, so that a pipe is refused below instead of waited for. Regular files ignore it.
    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    if (file.fd < 0) throw_bad_input("{}: cannot open: {}", path.string(), std::strerror(errno));
    struct stat info {};
    if (::fstat(file.fd, &info) != 0) {
        throw_bad_input("{}: cannot read: {}", path.string(), std::strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        throw_bad_input("{}: expected a regular file", path.string());
    }
    const auto size_bytes = static_cast<uint64_t>(info.st_size);
    if (size_bytes > max_size_bytes) {
        throw_bad_input("{}: {} bytes, expected at most {}", path.string(), size_bytes,
                        max_size_bytes);
    }
    std::vector<char> data(size_bytes);
    uint64_t done = 0;
    while (done < size_bytes) {
        const ssize_t got = ::read(file.fd, data.data() + done, size_bytes - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw_bad_input("{}: cannot read: {}", path.string(), std::strerror(errno));
        if (got == 0) {
            throw_bad_input("{}: ended after {} bytes, expected {}", path.string(), done,
                            size_bytes);
        }
        done += static_cast<uint64_t>(got);
    }
    return data;
}

bool is_temporary_name(const std::string& name) {
    // Parses NAME.PID-NUMBER.tmp from its end.
    std::string_view rest = name;
    const auto take_digits = [&] {
        const size_t before = rest.size();
        while (!rest.empty() && rest.back() >= '0' && rest.back() <= '9') rest.remove_suffix(1);
        return rest.size() < before;
    };
    const auto take = [&](std::string_view text) {
        if (!rest.ends_with(text)) return false;
        rest.remove_suffix(text.size());
        return true;
    };
    return take(".tmp") && take_digits() && take("-") && take_digits() && take(".") &&
           !rest.empty();
}

std::filesystem::path follow_links(const std::filesystem::path& path) {
    constexpr int kMaxLinks = 40;  // as many as the system follows
    std::filesystem::path target = path;
    for (int i = 0; i < kMaxLinks; ++i) {
        std::error_code failure;
        const std::filesystem::path link = std::filesystem::read_symlink(target, failure);
        if (failure) return target;  // no link, or nothing at all
        target = target.parent_path() / link;
    }
    throw_output_failed("{}: cannot follow its symbolic links: {}", path.string(),
                        std::strerror(ELOOP));
}

AtomicFile::AtomicFile(std::filesystem::path path)
    : path_(std::move(path)), target_(follow_links(path_)) {
    struct stat found {};
    if (::stat(path_.c_str(), &found) == 0 && !S_ISREG(found.st_mode)) {
        throw_output_failed("{}: expected a regular file, got {}", path_.string(),
                            S_ISDIR(found.st_mode) ? "a directory" : "a device, pipe or socket");
    }
    // Unique among the writers of this and other processes.
    static std::atomic<unsigned> counter{0};
    while (descriptor_ < 0) {
        temporary_path_ = target_;
        temporary_path_ += fmt::format(".{}-{}.tmp", ::getpid(), counter.fetch_add(1));
        descriptor_ = ::open(temporary_path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno == EEXIST) continue;
        if (descriptor_ < 0) fail("cannot create");
        // The lock tells other processes that this file is still being written. If
        // remove_abandoned_files() removed it between the two calls, another is made.
        struct stat info {};
        const bool taken = ::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (taken || (::fstat(descriptor_, &info) == 0 && info.st_nlink == 0)) {
            ::close(std::exchange(descriptor_, -1));
        }
    }
}

AtomicFile::~AtomicFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    ::unlink(temporary_path_.c_str());
}

void AtomicFile::fail(const char* action) const {
    const int reason = errno;
    const std::string name =
        target_ == path_ ? path_.string() : path_.string() + " -> " + target_.string();
    throw_output_failed("{}: {}: {}", name, action, std::strerror(reason));
}

void AtomicFile::write(const void* data, size_t size_bytes) {
    write_at(end_, data, size_bytes);
}

void AtomicFile::write_at(uint64_t offset, const void* data, size_t size_bytes) {
    const char* bytes = static_cast<const char*>(data);
    while (size_bytes > 0) {
        const ssize_t done = ::pwrite(descriptor_, bytes, size_bytes, static_cast<off_t>(offset));
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) fail("cannot write");
        bytes += done;
        size_bytes -= static_cast<size_t>(done);
        offset += static_cast<uint64_t>(done);
    }
    end_ = std::max(end_, offset);
}

void AtomicFile::resize(uint64_t size_bytes) {
    if (::ftruncate(descriptor_, static_cast<off_t>(size_bytes)) != 0) fail("cannot resize");
    end_ = size_bytes;
}

void AtomicFile::commit() {
    // Rename the file while it is still locked. fsync has reported every error that close could.
    if (::fsync(descriptor_) != 0) fail("cannot flush");
    if (::rename(temporary_path_.c_str(), target_.c_str()) != 0) fail("cannot finish writing");
    ::close(std::exchange(descriptor_, -1));
}

void remove_abandoned_files(const std::filesystem::path& directory, std::string_view prefix) {
    std::error_code failure;
    for (std::filesystem::directory_iterator entry(directory, failure), end;
         !failure && entry != end; entry.increment(failure)) {
        const std::filesystem::path& path = entry->path();
        const std::string name = path.filename().string();
        if (!name.starts_with(prefix) || !is_temporary_name(name)) continue;
        const Descriptor file{::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC)};
        if (file.fd >= 0 && ::flock(file.fd, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
    }
}

void remove_abandoned_versions(const std::filesystem::path& file) {
    const std::filesystem::path target = follow_links(std::filesystem::absolute(file));
    remove_abandoned_files(target.parent_path(), target.filename().string() + ".");
}

void write_file(const std::filesystem::path& path, std::string_view contents) {
    AtomicFile file(path);
    file.write(contents);
    file.commit();
}

void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::ifstream file(from, std::ios::binary);
    AtomicFile copy(to);
    std::vector<char> piece(size_t{1} << 20);
    while (file.good()) {
        file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        copy.write(piece.data(), static_cast<size_t>(file.gcount()));
    }
    if (!file.eof()) throw_bad_input("{}: cannot be read", from.string());
    copy.commit();
}

void ensure_directory(const std::filesystem::path& path) {
    std::error_code failure;
    // create_directories() takes a link whose directory is not there for a file.
    std::filesystem::create_directories(follow_links(path), failure);
    if (!failure && !std::filesystem::is_directory(path)) {
        throw_output_failed("{}: expected a directory, got a file", path.string());
    }
    if (failure) {
        throw_output_failed("{}: cannot create directory: {}", path.string(), failure.message());
    }
}

}  // namespace paim
