// Memory to work in that decoders leave to those after them.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace paim {

// Memory whose contents are anything. Aligned to cache lines.
class Buffer {
  public:
    // At least so many bytes. What it held is lost.
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

// Of one who works.
struct Workspace {
    Buffer contents;  // of frames
    Buffer rows;
};

// Of many, one after the other or at once.
class WorkspacePool {
  public:
    // Goes back to the pool, which outlives it.
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
            free_.reserve(++num_made_);  // so that leaving never fails
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
