// Memory to work in that many decoders, one after the other or at once, take and leave: a page that
// is touched for the first time costs more than what is done in it.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace paim {

class ScratchPool {
  public:
    // Memory of one who works; its contents are anything. Aligned to cache lines.
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

    struct Scratch {
        Buffer contents;  // of a frame
        Buffer rows;
    };

    // Goes back to the pool, which outlives it.
    class Lease {
      public:
        explicit Lease(ScratchPool& pool) : pool_(pool), scratch_(pool.take()) {}
        ~Lease() { pool_.leave(std::move(scratch_)); }
        Lease(const Lease&) = delete;
        Lease& operator=(const Lease&) = delete;
        Scratch& operator*() { return scratch_; }

      private:
        ScratchPool& pool_;
        Scratch scratch_;
    };

  private:
    Scratch take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) {
            free_.reserve(++num_made_);  // so that leaving never fails
            return {};
        }
        Scratch scratch = std::move(free_.back());
        free_.pop_back();
        return scratch;
    }
    void leave(Scratch scratch) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(scratch));
    }

    std::mutex mutex_;
    std::vector<Scratch> free_;
    size_t num_made_ = 0;
};

}  // namespace paim
