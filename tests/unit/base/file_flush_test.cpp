// What AtomicFile asks of the system, and in which order: this program's own fsync and rename write
// down that they were called before they do what the system's do, or fail where a test wants it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "tests/temporary_directory.h"

namespace {

struct Call {
    std::string name;
    ino_t file = 0;  // its inode, which it keeps when it gets another name
    off_t size_bytes = 0;
};

struct SystemCalls {
    std::vector<Call> made;
    int flush_failure = 0;  // an error number, 0: none
    int rename_failure = 0;
};

// Null: nobody is looking.
SystemCalls* system_calls = nullptr;

class WatchedCalls : public SystemCalls {
  public:
    WatchedCalls() { system_calls = this; }
    ~WatchedCalls() { system_calls = nullptr; }
    WatchedCalls(const WatchedCalls&) = delete;
    WatchedCalls& operator=(const WatchedCalls&) = delete;
};

// Writes a call down. Returns 0, or −1 and sets errno where it shall fail.
int watch(const char* name, const struct stat& file, int failure) {
    system_calls->made.push_back({name, file.st_ino, file.st_size});
    if (failure == 0) return 0;
    errno = failure;
    return -1;
}

int renamed(int from_directory, const char* from, int to_directory, const char* to) {
    if (system_calls != nullptr) {
        struct stat file {};
        ::fstatat(from_directory, from, &file, 0);
        if (watch("rename", file, system_calls->rename_failure) != 0) return -1;
    }
    return static_cast<int>(::syscall(SYS_renameat2, from_directory, from, to_directory, to, 0));
}

}  // namespace

extern "C" int fsync(int descriptor) {
    if (system_calls != nullptr) {
        struct stat file {};
        ::fstat(descriptor, &file);
        if (watch("fsync", file, system_calls->flush_failure) != 0) return -1;
    }
    return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

extern "C" int rename(const char* from, const char* to) noexcept {
    return renamed(AT_FDCWD, from, AT_FDCWD, to);
}

extern "C" int renameat(int from_directory, const char* from, int to_directory,
                        const char* to) noexcept {
    return renamed(from_directory, from, to_directory, to);
}

namespace paim {
namespace {

std::string text_of(const std::filesystem::path& path) {
    const std::vector<char> data = read_file(path, 100);
    return {data.begin(), data.end()};
}

// A name may only stand for what would survive a loss of power.
TEST(AtomicFile, IsFlushedWholeBeforeItGetsItsName) {
    const TemporaryDirectory directory;
    write_file(directory / "out", "old");
    AtomicFile file(directory / "out");
    file.write("all of ");
    file.write("it");
    const WatchedCalls calls;
    file.commit();
    ASSERT_EQ(calls.made.size(), 2u);
    EXPECT_EQ(calls.made[0].name, "fsync");
    EXPECT_EQ(calls.made[0].size_bytes, 9);
    EXPECT_EQ(calls.made[1].name, "rename");
    EXPECT_EQ(calls.made[1].size_bytes, 9);
    EXPECT_EQ(calls.made[0].file, calls.made[1].file);
    EXPECT_EQ(text_of(directory / "out"), "all of it");
}

// The old file stays, nothing else does.
TEST(AtomicFile, LeavesTheOldFileWhereFlushingOrRenamingFails) {
    for (const bool flush_fails : {true, false}) {
        const TemporaryDirectory directory;
        write_file(directory / "out", "old");
        WatchedCalls calls;
        (flush_fails ? calls.flush_failure : calls.rename_failure) = EIO;
        try {
            write_file(directory / "out", "new");
            ADD_FAILURE() << "expected an error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::output_failed);
            EXPECT_EQ(error.what(),
                      (directory / "out").string() +
                          (flush_fails ? ": cannot flush" : ": cannot finish writing") +
                          ": Input/output error");
        }
        EXPECT_EQ(calls.made.size(), flush_fails ? 1u : 2u);
        EXPECT_EQ(text_of(directory / "out"), "old");
        size_t num_files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(directory.path())) {
            ++num_files;
            EXPECT_EQ(entry.path().filename(), "out");
        }
        EXPECT_EQ(num_files, 1u);
    }
}

}  // namespace
}  // namespace paim
