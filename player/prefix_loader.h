// Reads a .paim that is large or still being written, on a thread of its own: a coarse animation from
// the first prefix that can be played, then one with more components from every longer prefix.
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "paim/base/error.h"
#include "player/file_prefix.h"

namespace paim::player {

// How a file is read.
struct LoaderPace {
    std::chrono::milliseconds interval{100};    // between two looks
    std::chrono::milliseconds patience{30000};  // while it stays as it is and cannot be played
    // The first asset takes so many bytes at most, unless the shortest prefix has more. Each one
    // after it takes up to four times as many, once it is asked for (read_on()).
    uint64_t first_bytes = kFirstBytes;
    // Whether errors end the reading even after the first asset (check()), because the file is
    // whole. Otherwise it may be mended.
    bool whole = false;

    static constexpr uint64_t kFirstBytes = uint64_t{24} << 20;
};

class PrefixLoader {
  public:
    // Starts reading; the file need not be there yet.
    explicit PrefixLoader(std::filesystem::path path, const LoaderPace& pace = LoaderPace());
    // Waits until the current look has ended.
    ~PrefixLoader() = default;
    PrefixLoader(const PrefixLoader&) = delete;
    PrefixLoader& operator=(const PrefixLoader&) = delete;

    // The first asset that can be played. Calls on_wait once if there are not enough bytes for it.
    // Errors as read_paim()'s; bad input if no byte comes for as long as `patience`.
    LoadedAsset wait_for_first(const std::function<void()>& on_wait);

    // The newest asset since the last call, if there is one; never waits.
    std::optional<LoadedAsset> take();

    // Lets the next part be read, if the file has more than the last asset. Called when that one is
    // drawn, so that its first picture has the processor for itself.
    void read_on();

    // Throws the error after which nothing more will be read, if there has been one.
    void check() const;

    // The error since the last call, or empty. Earlier assets stay valid, and longer prefixes are
    // still read.
    std::string take_error();

    // Bytes as of the last look, components as of the last reading.
    LoadProgress progress() const;

    // Waits for the end of a look at the file that begins after this call: what the file held at
    // the call has been read by then. Returns at once where no more looks come (the asset is
    // complete, or there will be none).
    void wait_for_look();

  private:
    using Clock = std::chrono::steady_clock;

    void run(const std::stop_token& stop);
    bool look(const std::stop_token& stop);                // false: there is nothing more to read
    bool read_what_is_there(const std::stop_token& stop);  // of one look; false as look()'s
    bool read_more(const FilePrefix& prefix);
    bool wait_to_read_on(const std::stop_token& stop);  // false: there is nobody to read for
    bool is_same_file(const FilePrefix& prefix) const;
    void wait_for_start(const FilePrefix& prefix);
    void report(const Error& error);

    const std::filesystem::path path_;
    const LoaderPace pace_;

    // Of the reading thread.
    std::vector<uint64_t> checksums_;  // of the file that was read last, or tried to
    uint64_t tried_bytes_ = 0;         // of it; 0: none
    uint64_t tried_inode_ = 0;         // of it
    uint64_t most_bytes_;              // that are read at once
    bool tried_in_vain_ = false;
    std::optional<Bounds> bounds_;    // of it
    uint32_t bounds_components_ = 0;  // of geometry, that they were made with
    bool replaced_ = false;           // since the last asset
    uint64_t waiting_bytes_ = 0;      // before the first asset
    Clock::time_point waiting_since_{};
    std::string last_error_;

    // Of both threads.
    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<LoadedAsset> newest_;
    bool started_ = false;          // there has been an asset
    bool waiting_ = false;          // there are not enough bytes for one
    bool reads_on_ = false;         // read_on() was called since the last asset
    std::optional<Error> failure_;  // there will be none
    std::string error_;
    LoadProgress progress_;
    uint64_t looks_begun_ = 0, looks_ended_ = 0;
    bool looks_over_ = false;

    std::jthread thread_;  // last, for it uses all the others
};

}  // namespace paim::player
