// Which errors to try until the smallest one is known whose file is not larger than a size.
#pragma once

#include <cstdint>
#include <optional>

namespace paim {

// The files that are searched: one for each error, or none.
class SizedFiles {
  public:
    SizedFiles() = default;
    virtual ~SizedFiles() = default;
    SizedFiles(const SizedFiles&) = delete;
    SizedFiles& operator=(const SizedFiles&) = delete;

    // About how many bytes the file of this error has; nothing if there is none.
    virtual std::optional<uint64_t> estimated_bytes(double error) = 0;
    // Makes the file of this error: its bytes; nothing if there is none.
    virtual std::optional<uint64_t> make(double error) = 0;
    // The file that was made last is the best so far.
    virtual void keep() = 0;
};

// Errors within which two are not told apart: 2 %.
constexpr double kErrorResolution = 1.02;
// Within this a coding that was chosen for one error is used for another, so that no estimate is
// asked for.
constexpr double kNearError = 1.06;

// Tries errors from least_error to largest_error. The file that was kept last is then the one of
// the smallest error whose bytes are at most most_bytes, to kErrorResolution of the error where
// bytes fall with the error as SizeCurve believes. False if none was kept: the file of
// largest_error has more bytes, or there is none.
// least_error  above 0, at most largest_error
bool find_smallest_error(SizedFiles& files, double least_error, double largest_error,
                         uint64_t most_bytes);

}  // namespace paim
