// What files ask of the system, and in which order: this program's own read, pwrite, fsync and
// rename write down that they were called before they do what the system's do, or fail, or do a
// part of what they were asked for, where a test wants it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
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

// Part of a file's bytes on their way.
struct Piece {
    off_t offset = 0;  // of a pwrite
    size_t asked_bytes = 0;

    bool operator==(const Piece&) const = default;
};

struct SystemCalls {
    std::vector<Call> made;
    int flush_failure = 0;  // an error number, 0: none
    int rename_failure = 0;

    std::vector<Piece> reads, writes;                        // those that were not interrupted
    size_t most_bytes = std::numeric_limits<size_t>::max();  // that one read or pwrite takes
    size_t bytes_left = std::numeric_limits<size_t>::max();  // that they take together
    int write_failure = 0;         // of a pwrite once none are left; a read then finds the end
    bool is_interrupting = false;  // every other read or pwrite is interrupted by a signal
    bool was_interrupted = false;
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

// How many bytes a read or a pwrite takes; −1 and errno if a signal interrupts it.
ssize_t taken_bytes(size_t asked_bytes) {
    SystemCalls& calls = *system_calls;
    if (calls.is_interrupting && !calls.was_interrupted) {
        calls.was_interrupted = true;
        errno = EINTR;
        return -1;
    }
    calls.was_interrupted = false;
    const size_t taken = std::min({asked_bytes, calls.most_bytes, calls.bytes_left});
    calls.bytes_left -= taken;
    return static_cast<ssize_t>(taken);
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

extern "C" ssize_t read(int descriptor, void* data, size_t size_bytes) {
    if (system_calls != nullptr) {
        const ssize_t taken = taken_bytes(size_bytes);
        if (taken < 0) return -1;
        system_calls->reads.push_back({0, size_bytes});
        size_bytes = static_cast<size_t>(taken);
    }
    return ::syscall(SYS_read, descriptor, data, size_bytes);
}

extern "C" ssize_t pwrite(int descriptor, const void* data, size_t size_bytes, off_t offset) {
    if (system_calls != nullptr) {
        const ssize_t taken = taken_bytes(size_bytes);
        if (taken < 0) return -1;
        system_calls->writes.push_back({offset, size_bytes});
        if (taken == 0 && size_bytes > 0 && system_calls->write_failure != 0) {
            errno = system_calls->write_failure;
            return -1;
        }
        size_bytes = static_cast<size_t>(taken);
    }
    return ::syscall(SYS_pwrite64, descriptor, data, size_bytes, offset);
}

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

void expect_only_the_old_file(const TemporaryDirectory& directory) {
    EXPECT_EQ(text_of(directory / "out"), "old");
    size_t num_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path())) {
        ++num_files;
        EXPECT_EQ(entry.path().filename(), "out");
    }
    EXPECT_EQ(num_files, 1u);
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

// The system may take fewer bytes than it is given, and a signal may interrupt it before it takes
// any.
TEST(AtomicFile, GoesOnWhereTheSystemStoppedWriting) {
    for (const bool is_interrupting : {false, true}) {
        const TemporaryDirectory directory;
        AtomicFile file(directory / "out");
        {
            WatchedCalls calls;
            calls.most_bytes = 4;
            calls.is_interrupting = is_interrupting;
            file.write("ten bytes ");
            file.write_at(20, "the end", 7);
            file.write("!");  // at the end
            EXPECT_EQ(calls.writes,
                      (std::vector<Piece>{{0, 10}, {4, 6}, {8, 2}, {20, 7}, {24, 3}, {27, 1}}));
        }
        file.write_at(10, "in between", 10);
        file.commit();
        EXPECT_EQ(text_of(directory / "out"), "ten bytes in betweenthe end!");
    }
}

// A disk that is full takes what it has room for, and fails at the next call.
TEST(AtomicFile, LeavesTheOldFileWhereTheDiskIsFull) {
    const TemporaryDirectory directory;
    write_file(directory / "out", "old");
    {
        WatchedCalls calls;
        calls.bytes_left = 6;
        calls.write_failure = ENOSPC;
        try {
            write_file(directory / "out", "ten bytes ");
            ADD_FAILURE() << "expected an error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::output_failed);
            EXPECT_EQ(error.what(),
                      (directory / "out").string() + ": cannot write: No space left on device");
        }
        EXPECT_EQ(calls.writes, (std::vector<Piece>{{0, 10}, {6, 4}}));
        EXPECT_TRUE(calls.made.empty());
    }
    expect_only_the_old_file(directory);
}

TEST(ReadFile, GoesOnWhereTheSystemStoppedReading) {
    const TemporaryDirectory directory;
    write_file(directory / "in", "ten bytes.");
    for (const bool is_interrupting : {false, true}) {
        WatchedCalls calls;
        calls.most_bytes = 4;
        calls.is_interrupting = is_interrupting;
        EXPECT_EQ(text_of(directory / "in"), "ten bytes.");
        EXPECT_EQ(calls.reads, (std::vector<Piece>{{0, 10}, {0, 6}, {0, 2}}));
    }
}

// Another process may shorten the file while it is read.
TEST(ReadFile, RefusesAFileThatEndsEarlier) {
    const TemporaryDirectory directory;
    write_file(directory / "in", "ten bytes.");
    WatchedCalls calls;
    calls.bytes_left = 7;
    try {
        read_file(directory / "in", 100);
        ADD_FAILURE() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_EQ(error.what(), (directory / "in").string() + ": ended after 7 bytes, expected 10");
    }
    EXPECT_EQ(calls.reads, (std::vector<Piece>{{0, 10}, {0, 3}}));
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
        expect_only_the_old_file(directory);
    }
}

}  // namespace
}  // namespace paim
