// Reads a .paim that is still being written, on a thread of its own: a coarse animation from the
// first prefix that can be played, then one with more components from every longer prefix.
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

// The time between two looks at a file, and how long it may stay as it is before it can be played.
struct LoaderPace {
    std::chrono::milliseconds interval{100};
    std::chrono::milliseconds patience{30000};
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
    bool look();                // false: there is nothing more to read
    bool read_what_is_there();  // of one look; false as look()'s
    bool read_more(const FilePrefix& prefix);
    bool is_same_file(const FilePrefix& prefix) const;
    void wait_for_start(const FilePrefix& prefix);
    void report(const Error& error);

    const std::filesystem::path path_;
    const LoaderPace pace_;

    // Of the reading thread.
    std::vector<uint64_t> checksums_;  // of the file that was read last, or tried to
    uint64_t tried_bytes_ = 0;         // of it; 0: none
    uint64_t tried_inode_ = 0;         // of it
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
    std::optional<Error> failure_;  // there will be none
    std::string error_;
    LoadProgress progress_;
    uint64_t looks_begun_ = 0, looks_ended_ = 0;
    bool looks_over_ = false;

    std::jthread thread_;  // last, for it uses all the others
};

}  // namespace paim::player
