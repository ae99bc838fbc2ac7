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

}  // namespace
}  // namespace paim
