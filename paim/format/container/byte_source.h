// Where the bytes of a Paim file come from: a file, memory, or anything else that a program has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace paim {

// Bytes that are read in any order, by several threads at once.
class ByteSource {
  public:
    virtual ~ByteSource();

    // How many bytes there are now. A source that grows has more later, never fewer.
    virtual uint64_t size_bytes() const = 0;

    // Fills `out` with the bytes from `offset` on. Returns how many there were: out.size(), or fewer
    // where the source ends. Error (bad input) if bytes that are there cannot be read.
    virtual size_t read(uint64_t offset, std::span<uint8_t> out) const = 0;
};

// A file, whole or still growing: its size is that of the moment.
class FileSource : public ByteSource {
  public:
    // Opens it. Errors (bad input) name the path: it cannot be opened, or is no regular file.
    explicit FileSource(const std::filesystem::path& path);
    ~FileSource() override;
    FileSource(const FileSource&) = delete;
    FileSource& operator=(const FileSource&) = delete;

    uint64_t size_bytes() const override;
    size_t read(uint64_t offset, std::span<uint8_t> out) const override;

  private:
    [[noreturn]] void fail() const;

    std::filesystem::path path_;
    int descriptor_ = -1;
};

// Bytes in memory, which outlive the source and do not change.
class MemorySource : public ByteSource {
  public:
    explicit MemorySource(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    uint64_t size_bytes() const override { return bytes_.size(); }
    size_t read(uint64_t offset, std::span<uint8_t> out) const override;

  private:
    std::span<const uint8_t> bytes_;
};

}  // namespace paim
