// Sources of the bytes of a Paim file: a file, memory, or a class of the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <utility>

namespace paim {

// Bytes that several threads may read at once, in any order.
class ByteSource {
  public:
    virtual ~ByteSource();

    // The number of bytes that can be read now. It may grow later, but never shrinks.
    virtual uint64_t size_bytes() const = 0;

    // Fills `out` with the bytes from `offset` on. Returns the number of bytes read: out.size(), or
    // fewer if the source ends. Error (bad input) if bytes below size_bytes() cannot be read.
    virtual size_t read(uint64_t offset, std::span<uint8_t> out) const = 0;
};

// A file. It may still be growing: size_bytes() is its present size.
class FileSource : public ByteSource {
  public:
    // Opens the file. Errors (bad input) name the path: it cannot be opened, or is not a regular
    // file.
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

// The first bytes of another source, as if it ended after them.
class FirstBytes : public ByteSource {
  public:
    FirstBytes(std::shared_ptr<const ByteSource> source, uint64_t most_bytes)
        : source_(std::move(source)), most_bytes_(most_bytes) {}

    uint64_t size_bytes() const override;
    size_t read(uint64_t offset, std::span<uint8_t> out) const override;

  private:
    std::shared_ptr<const ByteSource> source_;
    uint64_t most_bytes_;
};

}  // namespace paim
