// Bounded reads and all-or-nothing writes.
#include "paim/base/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "paim/base/error.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

TEST(ReadFile, RefusesMissingDirectoryAndTooLarge) {
    const TemporaryDirectory directory;
    EXPECT_THROW(read_file(directory / "none", 10), Error);
    EXPECT_THROW(read_file(directory.path(), 1 << 20), Error);
    write_file(directory / "eleven", "12345678901");
    EXPECT_THROW(read_file(directory / "eleven", 10), Error);
    EXPECT_EQ(read_file(directory / "eleven", 11).size(), 11u);
}

TEST(ReadFile, RefusesPipesWithoutWaiting) {
    const TemporaryDirectory directory;
    ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0600), 0);
    EXPECT_THROW(read_file(directory / "pipe", 10), Error);
}

TEST(AtomicFile, LeavesNothingWithoutCommit) {
    const TemporaryDirectory directory;
    {
        AtomicFile file(directory / "out");
        file.write("half");
    }
    EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

TEST(AtomicFile, ReplacesOnlyOnCommit) {
    const TemporaryDirectory directory;
    write_file(directory / "out", "old");
    AtomicFile file(directory / "out");
    file.write_at(4, "new!", 4);
    file.write_at(0, "All ", 4);
    EXPECT_EQ(read_file(directory / "out", 100).size(), 3u);
    file.commit();
    const auto data = read_file(directory / "out", 100);
    EXPECT_EQ(std::string(data.begin(), data.end()), "All new!");
}

TEST(AtomicFile, ReportsUnwritableDirectory) {
    try {
        AtomicFile file("/nonexistent-directory/out");
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::output_failed);
        EXPECT_NE(std::string(error.what()).find("/nonexistent-directory/out"), std::string::npos);
    }
}

std::string contents_of(const std::filesystem::path& path) {
    const std::vector<char> data = read_file(path, 1000);
    return {data.begin(), data.end()};
}

std::string error_of_writing(const std::filesystem::path& path) {
    try {
        write_file(path, "new");
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::output_failed);
        return error.what();
    }
    ADD_FAILURE() << "expected an error: " << path;
    return {};
}

// As tools that know nothing of renaming write through links.
TEST(AtomicFile, WritesWhatALinkLeadsTo) {
    const TemporaryDirectory directory;
    std::filesystem::create_directories(directory / "here");
    std::filesystem::create_directories(directory / "there");
    write_file(directory / "there/file", "old");
    std::filesystem::create_symlink("../there/file", directory / "here/relative");
    std::filesystem::create_symlink(directory / "here/relative", directory / "absolute");
    std::filesystem::create_symlink("there/none", directory / "dangling");
    std::filesystem::create_symlink("there", directory / "folder");
    for (const char* const link : {"here/relative", "absolute"}) {
        AtomicFile file(directory / link);
        file.write(link);
        // The temporary file is where renaming it is one step.
        EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory / "there"), {}), 2);
        file.commit();
        EXPECT_TRUE(std::filesystem::is_symlink(directory / link));
        EXPECT_EQ(contents_of(directory / "there/file"), link);
    }
    write_file(directory / "dangling", "made");
    EXPECT_TRUE(std::filesystem::is_symlink(directory / "dangling"));
    EXPECT_EQ(contents_of(directory / "there/none"), "made");
    write_file(directory / "folder/in_it", "there");
    EXPECT_EQ(contents_of(directory / "there/in_it"), "there");
}

TEST(AtomicFile, RefusesLinksThatLeadToNoFile) {
    const TemporaryDirectory directory;
    std::filesystem::create_directories(directory / "folder");
    std::filesystem::create_symlink("second", directory / "first");
    std::filesystem::create_symlink("first", directory / "second");
    std::filesystem::create_symlink("folder", directory / "link");
    std::filesystem::create_symlink("none/file", directory / "nowhere");
    const std::string first = (directory / "first").string();
    EXPECT_EQ(error_of_writing(first),
              first + ": cannot follow its symbolic links: Too many levels of symbolic links");
    EXPECT_THROW(ensure_directory(first), Error);
    for (const char* const name : {"folder", "link"}) {
        const std::string path = (directory / name).string();
        EXPECT_EQ(error_of_writing(path), path + ": expected a regular file, got a directory");
    }
    const std::string nowhere = (directory / "nowhere").string();
    EXPECT_EQ(error_of_writing(nowhere), nowhere + " -> " + (directory / "none/file").string() +
                                             ": cannot create: No such file or directory");
    EXPECT_TRUE(std::filesystem::is_symlink(nowhere));
    ASSERT_EQ(::mkfifo((directory / "pipe").c_str(), 0600), 0);
    EXPECT_NE(error_of_writing(directory / "pipe").find("expected a regular file, got a device"),
              std::string::npos);
    EXPECT_EQ(error_of_writing("/dev/null"),
              "/dev/null: expected a regular file, got a device, pipe or socket");
}

TEST(EnsureDirectory, MakesWhatALinkLeadsTo) {
    const TemporaryDirectory directory;
    std::filesystem::create_symlink("deep/folder", directory / "link");
    ensure_directory(directory / "link");
    EXPECT_TRUE(std::filesystem::is_directory(directory / "deep/folder"));
    ensure_directory(directory / "link");
    EXPECT_TRUE(std::filesystem::is_symlink(directory / "link"));
}

// Temporary files of killed processes lie where the file is.
TEST(AbandonedVersions, AreRemovedBehindLinks) {
    const TemporaryDirectory directory;
    std::filesystem::create_directories(directory / "there");
    std::filesystem::create_symlink("there/file", directory / "link");
    for (const char* const name : {"there/file.1-2.tmp", "link.1-2.tmp", "there/other.1-2.tmp"}) {
        write_file(directory / name, "half");
    }
    remove_abandoned_versions(directory / "link");
    EXPECT_FALSE(std::filesystem::exists(directory / "there/file.1-2.tmp"));
    EXPECT_TRUE(std::filesystem::exists(directory / "link.1-2.tmp"));
    EXPECT_TRUE(std::filesystem::exists(directory / "there/other.1-2.tmp"));
}

}  // namespace
}  // namespace paim
