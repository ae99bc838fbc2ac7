// Parallel loops on oneTBB, and a limit on its threads. Paim's tools use them.
#pragma once

#include <memory>

namespace paim {

// From now on parallel loops of this process run on oneTBB, on every core.
void use_tbb();

// Limits the threads of all loops on oneTBB during its lifetime; 0 means every core.
class ThreadLimit {
  public:
    explicit ThreadLimit(int num_threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Control;
    std::unique_ptr<Control> control_;
};

}  // namespace paim
