// Files: read with a bound, write all or nothing.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace paim {

// The whole file. Errors (bad input) name the path: missing, a directory, unreadable, or larger
// than max_size_bytes.
std::vector<char> read_file(const std::filesystem::path& path, uint64_t max_size_bytes);

// A file that appears under its name only when commit() has written, flushed and renamed all of it;
// otherwise nothing is left behind. Errors (output failed) name the path and the system's reason.
class AtomicFile {
  public:
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* data, size_t size_bytes);                      // at the end
    void write_at(uint64_t offset, const void* data, size_t size_bytes);  // anywhere
    void write(std::string_view text) { write(text.data(), text.size()); }
    void resize(uint64_t size_bytes);  // what lies beyond the last write is zero
    void commit();

  private:
    [[noreturn]] void fail(const char* action) const;

    std::filesystem::path path_;
    std::filesystem::path temporary_path_;
    int descriptor_ = -1;
    uint64_t end_ = 0;
};

// Whether a file of this name is one that AtomicFile has not committed yet.
bool is_temporary_name(const std::string& name);

// Removes what AtomicFile left in this directory where a process was killed; files that are being
// written, by whichever process, stay.
void remove_abandoned_files(const std::filesystem::path& directory, std::string_view prefix = {});

// Writes the text as a whole, through AtomicFile.
void write_file(const std::filesystem::path& path, std::string_view contents);

// Creates the directory and its parents. Error (output failed) if it cannot be, or is a file.
void ensure_directory(const std::filesystem::path& path);

}  // namespace paim
