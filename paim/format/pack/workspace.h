// Scratch memory that decoders reuse one after another.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace paim {

// Memory with undefined contents, aligned to cache lines.
class Buffer {
  public:
    // Makes it at least num_bytes large. The contents are lost.
    std::byte* resize(size_t num_bytes) {
        const size_t num_lines = (num_bytes + sizeof(Line) - 1) / sizeof(Line);
        if (num_lines > num_lines_) {
            lines_.reset();
            lines_ = std::make_unique_for_overwrite<Line[]>(num_lines);
            num_lines_ = num_lines;
        }
        return lines_ ? lines_[0].bytes : nullptr;
    }

  private:
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    std::unique_ptr<Line[]> lines_;
    size_t num_lines_ = 0;
};

// The scratch memory of one decoder.
struct Workspace {
    Buffer contents;  // contents of Zstandard frames
    Buffer rows;
};

// Workspaces that any number of decoders borrow, one after another or at once.
class WorkspacePool {
  public:
    // A borrowed workspace. Its destructor returns it to the pool, which outlives it.
    class Lease {
      public:
        explicit Lease(WorkspacePool& pool) : pool_(pool), workspace_(pool.take()) {}
        ~Lease() { pool_.leave(std::move(workspace_)); }
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        Workspace& operator*() { return workspace_; }

      private:
        WorkspacePool& pool_;
        Workspace workspace_;
    };

  private:
    Workspace take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) {
            free_.reserve(++num_made_);  // so that returning one never fails
            return {};
        }
        Workspace workspace = std::move(free_.back());
        free_.pop_back();
        return workspace;
    }
    void leave(Workspace workspace) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(workspace));
    }

    std::mutex mutex_;
    std::vector<Workspace> free_;
    size_t num_made_ = 0;
};

}  // namespace paim
