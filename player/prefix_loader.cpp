// Watching a file that is being written.
#include "player/prefix_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paim/codec/sequence_bounds.h"

namespace paim::player {

PrefixLoader::PrefixLoader(std::filesystem::path path, const LoaderPace& pace)
    : path_(std::move(path)),
      pace_(pace),
      most_bytes_(pace.first_bytes),
      waiting_since_(Clock::now()),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

LoadedAsset PrefixLoader::wait_for_first(const std::function<void()>& on_wait) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return newest_ || failure_ || waiting_; });
    if (!newest_ && !failure_) {
        lock.unlock();
        on_wait();
        lock.lock();
        changed_.wait(lock, [&] { return newest_ || failure_; });
    }
    if (!newest_) throw *failure_;
    return *std::exchange(newest_, std::nullopt);
}

std::optional<LoadedAsset> PrefixLoader::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(newest_, std::nullopt);
}

void PrefixLoader::read_on() {
    {
        const std::scoped_lock lock(mutex_);
        reads_on_ = true;
    }
    changed_.notify_all();
}

void PrefixLoader::check() const {
    const std::scoped_lock lock(mutex_);
    if (failure_) throw *failure_;
}

std::string PrefixLoader::take_error() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(error_, {});
}

LoadProgress PrefixLoader::progress() const {
    const std::scoped_lock lock(mutex_);
    return progress_;
}

void PrefixLoader::wait_for_look() {
    std::unique_lock lock(mutex_);
    const uint64_t next = looks_begun_ + 1;
    changed_.wait(lock, [&] { return looks_ended_ >= next || looks_over_; });
}

void PrefixLoader::run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        const auto start = Clock::now();
        if (!look(stop)) break;
        // Long files take long to read: no more than half of the time goes into that.
        const auto pause = std::max<Clock::duration>(pace_.interval, Clock::now() - start);
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, stop, pause, [] { return false; });
    }
    {
        const std::scoped_lock lock(mutex_);
        looks_over_ = true;
    }
    changed_.notify_all();
}

bool PrefixLoader::look(const std::stop_token& stop) {
    {
        const std::scoped_lock lock(mutex_);
        ++looks_begun_;
    }
    const bool more = read_what_is_there(stop);
    {
        const std::scoped_lock lock(mutex_);
        ++looks_ended_;
    }
    changed_.notify_all();
    return more;
}

bool PrefixLoader::read_what_is_there(const std::stop_token& stop) {
    FilePrefix prefix;
    try {
        prefix = inspect_prefix(path_);
        while (read_more(prefix)) {
            if (tried_bytes_ >= prefix.playable_bytes()) return true;
            if (!wait_to_read_on(stop)) return false;
            prefix = inspect_prefix(path_);
        }
        return false;
    } catch (const Error& error) {
        // What is written over while it is read looks damaged and is not.
        if (!prefix.prefixes.empty() && !is_same_file(prefix)) {
            tried_bytes_ = 0;
            return true;
        }
        report(error);
    } catch (const std::exception& error) {  // of the file system, or memory
        report(Error(ExitCode::bad_input, path_.string() + ": " + error.what()));
    }
    const std::scoped_lock lock(mutex_);
    return !failure_;
}

bool PrefixLoader::read_more(const FilePrefix& prefix) {
    const bool other = !prefix.prefixes.empty() && prefix.checksums != checksums_;
    if (other) {
        replaced_ = replaced_ || !checksums_.empty();
        checksums_ = prefix.checksums;
        tried_bytes_ = 0;
        most_bytes_ = pace_.first_bytes;
        bounds_.reset();
    }
    // A damaged file may be mended by another that has the same table.
    if (tried_in_vain_ && prefix.inode != tried_inode_) tried_bytes_ = 0;
    const uint64_t playable_bytes = prefix.playable_bytes(tried_bytes_, most_bytes_);
    if (tried_in_vain_) tried_bytes_ = std::min(tried_bytes_, playable_bytes);
    {
        const std::scoped_lock lock(mutex_);
        const uint32_t components = other ? 0 : progress_.components;
        progress_ = prefix.progress();
        progress_.components = components;
    }
    if (playable_bytes <= tried_bytes_) {
        wait_for_start(prefix);
        const std::scoped_lock lock(mutex_);
        return !failure_;
    }
    tried_bytes_ = playable_bytes;
    tried_inode_ = prefix.inode;
    tried_in_vain_ = true;
    LoadedAsset loaded = read_prefix(path_, prefix, playable_bytes);
    const bool complete = loaded.asset->complete;
    const uint32_t geometry_components = loaded.asset->moving().positions.num_components;
    if (!bounds_ || complete || bounds_components_ != geometry_components) {
        bounds_ = bounds_so_far(*loaded.asset);
        bounds_components_ = geometry_components;
    }
    loaded.bounds = *bounds_;
    tried_in_vain_ = false;
    constexpr uint64_t kGrowth = 4;
    most_bytes_ = std::max(most_bytes_, kGrowth * playable_bytes);
    {
        const std::scoped_lock lock(mutex_);
        // A model that nobody took may have been another file's, too.
        loaded.replaced = std::exchange(replaced_, false) || (newest_ && newest_->replaced);
        progress_ = loaded.progress;
        newest_ = std::move(loaded);
        started_ = true;
        reads_on_ = false;
    }
    last_error_.clear();
    changed_.notify_all();
    return !complete;
}

bool PrefixLoader::wait_to_read_on(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    return changed_.wait(lock, stop, [&] { return reads_on_; });
}

bool PrefixLoader::is_same_file(const FilePrefix& prefix) const {
    try {
        const FilePrefix now = inspect_prefix(path_);
        return now.checksums == prefix.checksums && now.size_bytes >= prefix.size_bytes;
    } catch (const std::exception&) {
        return false;
    }
}

void PrefixLoader::wait_for_start(const FilePrefix& prefix) {
    const auto now = Clock::now();
    {
        const std::scoped_lock lock(mutex_);
        if (started_) return;
        waiting_ = true;
    }
    changed_.notify_all();
    if (prefix.size_bytes != waiting_bytes_) {
        waiting_bytes_ = prefix.size_bytes;
        waiting_since_ = now;
    }
    if (now - waiting_since_ < pace_.patience) return;
    const auto patience_s = std::chrono::duration<double>(pace_.patience).count();
    const std::string expected =
        prefix.prefixes.empty()
            ? "a header and section table"
            : fmt::format("the {} that can be played", prefix.prefixes.front().size_bytes);
    report(Error(ExitCode::bad_input,
                 fmt::format("{}: {} bytes, expected at least {}, and no more came for {} s",
                             path_.string(), prefix.size_bytes, expected, patience_s)));
}

void PrefixLoader::report(const Error& error) {
    {
        const std::scoped_lock lock(mutex_);
        if (!started_ || pace_.whole) {
            failure_ = error;
        } else if (error.what() != last_error_) {  // said once, not at every look
            error_ = error.what();
        }
    }
    last_error_ = error.what();
    changed_.notify_all();
}

}  // namespace paim::player
