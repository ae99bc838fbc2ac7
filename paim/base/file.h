// Files: bounded reads, and writes that happen completely or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace paim {

// Reads the whole file. Errors (bad input) name the path: missing, a directory, unreadable, or
// larger than max_size_bytes.
std::vector<char> read_file(const std::filesystem::path& path, uint64_t max_size_bytes);

// The file that is written when this path is: where its last name is a symbolic link, what the link
// leads to in the end, whether that exists or not. Other paths stay as they are.
// Error (output failed) if links lead in a circle.
std::filesystem::path follow_links(const std::filesystem::path& path);

// Writes a file under a temporary name; commit() flushes it and renames it to its own. Without
// commit() nothing is left behind. A symbolic link stays one: what it leads to is written, and the
// temporary file lies next to that. Errors (output failed) name the path and the system's reason;
// it is one, too, if the path is there and no regular file.
class AtomicFile {
  public:
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* data, size_t size_bytes);                      // at the end
    void write_at(uint64_t offset, const void* data, size_t size_bytes);  // anywhere
    void write(std::string_view text) { write(text.data(), text.size()); }
    void resize(uint64_t size_bytes);  // bytes beyond the last write are zero
    void commit();

  private:
    [[noreturn]] void fail(const char* action) const;

    std::filesystem::path path_;    // as given
    std::filesystem::path target_;  // what it leads to
    std::filesystem::path temporary_path_;
    int descriptor_ = -1;
    uint64_t end_ = 0;
};

// The most bytes by which a temporary name is longer than the file's own.
constexpr size_t kMaxTemporarySuffix = 40;

// Whether this is the temporary name of a file that AtomicFile has not committed yet.
bool is_temporary_name(const std::string& name);

// Removes the temporary files of killed processes from this directory. Files that any process is
// still writing stay.
void remove_abandoned_files(const std::filesystem::path& directory, std::string_view prefix = {});

// Removes those of this file alone, wherever symbolic links lead to.
void remove_abandoned_versions(const std::filesystem::path& file);

// Writes the text as a whole, through AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view contents);

// Copies a file, through AtomicFile. Errors (bad input) if the first cannot be read.
void copy_whole_file(const std::filesystem::path& from, const std::filesystem::path& to);

// Creates the directory and its parents; of a symbolic link, what it leads to. Error (output failed)
// if that fails, or if it is a file.
void ensure_directory(const std::filesystem::path& path);

}  // namespace paim
